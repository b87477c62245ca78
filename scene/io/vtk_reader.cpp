#include "scene/io/vtk_reader.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/text_file.h"
#include "scene/io/vtk_arrays.h"

namespace interflect::scene::io {
namespace {

/// VTK's numbers for the cells that have to do with polygons.
enum Cell { vertex = 1, polyline = 4, triangle = 5, strip = 6, polygon = 7, pixel = 8, quad = 9 };

/// What the cells of a piece are called by one of their arrays.
class Labels {
 public:
  explicit Labels(NameList& list) : list_(list) {}

  void read(const VtkArrays& arrays, const XmlElement& array, std::uint64_t cells) {
    name_ = *array.attribute("Name");
    const std::string* type = array.attribute("type");
    texts_ = type && *type == "String";
    if (texts_)
      words_ = arrays.texts(array, cells);
    else
      numbers_ = arrays.numbers(array, cells);
  }

  std::uint32_t of(std::size_t cell) const {
    if (name_.empty()) return list_.index_of("");
    return list_.index_of(texts_ ? one_line(words_[cell]) : one_line(name_) + core::format("-%.12g", numbers_[cell]));
  }

 private:
  NameList& list_;
  std::string name_;
  bool texts_ = false;
  std::vector<std::string> words_;
  std::vector<double> numbers_;
};

class VtkReader {
 public:
  VtkReader(const std::string& bytes, bool poly_data, const std::string& shown)
      : poly_data_(poly_data),
        root_(parse_xml(bytes, "AppendedData", shown)),
        arrays_(root_, shown),
        most_(arrays_.most(bytes.size())) {}

  MeshFile run() {
    const char* type = poly_data_ ? "PolyData" : "UnstructuredGrid";
    const XmlElement* set = root_.name == "VTKFile" ? root_.child(type) : nullptr;
    if (!set) arrays_.fail(root_, std::string("a <VTKFile> with <") + type + "> is expected");
    for (const XmlElement& piece : set->children)
      if (piece.name == "Piece") read(piece);
    if (ignored_ > 0)
      mesh_.notes.push_back(core::format("%zu %s ignored", ignored_,
                                         ignored_ == 1 ? "cell that is no polygon" : "cells that are no polygons"));
    mesh_.groups = groups_.names();
    mesh_.materials = materials_.names();
    return std::move(mesh_);
  }

 private:
  std::uint64_t count(const XmlElement& piece, const char* key) const {
    const std::string* text = piece.attribute(key);
    if (!text) return 0;
    std::uint64_t value = 0;
    const auto [stop, error] = std::from_chars(text->data(), text->data() + text->size(), value);
    if (text->empty() || error != std::errc() || stop != text->data() + text->size())
      arrays_.fail(piece, std::string(key) + " is not a count");
    if (value > most_) arrays_.fail(piece, core::format("%s is more than the file can hold", key));
    return value;
  }

  const XmlElement& array(const XmlElement& within, const char* name) const {
    for (const XmlElement& element : within.children)
      if (const std::string* given = element.attribute("Name"); element.name == "DataArray" && given && *given == name)
        return element;
    arrays_.fail(within, std::string("the array '") + name + "' is missing");
  }

  void read(const XmlElement& piece) {
    first_vertex_ = mesh_.vertices.size();
    read_points(piece, count(piece, "NumberOfPoints"));
    constexpr std::array<std::pair<const char*, Cell>, 4> parts = {
        {{"Verts", vertex}, {"Lines", polyline}, {"Strips", strip}, {"Polys", polygon}}};
    // Cell data run over the parts in this order.
    constexpr std::array<std::size_t, 4> order = {0, 1, 3, 2};
    std::uint64_t cells = poly_data_ ? 0 : count(piece, "NumberOfCells");
    if (poly_data_)
      for (const auto& part : parts) cells += count(piece, (std::string("NumberOf") + part.first).c_str());
    read_labels(piece, cells);
    cell_ = 0;
    if (!poly_data_) return read_cells(piece, "Cells", cells, std::nullopt);
    for (const std::size_t k : order)
      read_cells(piece, parts[k].first, count(piece, (std::string("NumberOf") + parts[k].first).c_str()),
                 parts[k].second);
  }

  void read_points(const XmlElement& piece, std::uint64_t points) {
    if (points == 0) return;
    const XmlElement* within = piece.child("Points");
    const XmlElement* element = within ? within->child("DataArray") : nullptr;
    if (!element) arrays_.fail(piece, "it has no <Points>");
    const std::vector<double> x = arrays_.numbers(*element, 3 * points);
    for (std::size_t k = 0; k < x.size(); k += 3) mesh_.vertices.emplace_back(x[k], x[k + 1], x[k + 2]);
    if (const std::string* type = element->attribute("type"); type && *type == "Float32") mesh_.single_precision = true;
  }

  void read_labels(const XmlElement& piece, std::uint64_t cells) {
    group_.emplace(groups_);
    material_.emplace(materials_);
    const XmlElement* data = piece.child("CellData");
    if (!data) return;
    const auto read_first = [&](std::initializer_list<const char*> names, Labels& out) {
      for (const char* name : names)
        for (const XmlElement& element : data->children) {
          const std::string *given = element.attribute("Name"), *width = element.attribute("NumberOfComponents");
          if (!given || *given != name || (width && *width != "1")) continue;
          return out.read(arrays_, element, cells);
        }
    };
    read_first({"group", "surface", "region", "part"}, *group_);
    read_first({"material"}, *material_);
  }

  /// @param type  of all of them; nothing: the array "types" says it
  void read_cells(const XmlElement& piece, const char* part, std::uint64_t cells, std::optional<Cell> type) {
    if (cells == 0) return;
    const XmlElement* within = piece.child(part);
    if (!within) arrays_.fail(piece, std::string("it has no <") + part + ">");
    const XmlElement &offsets_of = array(*within, "offsets"), &corners_of = array(*within, "connectivity");
    const std::vector<double> ends = arrays_.numbers(offsets_of, cells);
    double before = 0;
    for (const double end : ends) {
      if (!(end >= before && end <= static_cast<double>(most_)))
        arrays_.fail(offsets_of, "offsets of cells ascend, within what the file can hold");
      before = end;
    }
    const std::vector<double> corners = arrays_.numbers(corners_of, static_cast<std::uint64_t>(before));
    const auto points = static_cast<double>(mesh_.vertices.size() - first_vertex_);
    for (const double corner : corners)
      if (!(corner >= 0 && corner < points) || corner != std::floor(corner))
        arrays_.fail(corners_of,
                     core::format("a cell refers to point %.12g of %.0f, which count from 0", corner, points));
    const std::vector<double> types = type ? std::vector<double>() : arrays_.numbers(array(*within, "types"), cells);
    std::size_t at = 0;
    for (std::size_t k = 0; k < ends.size(); ++k, ++cell_) {
      const auto end = static_cast<std::size_t>(ends[k]);
      corners_.clear();
      for (; at < end; ++at)
        corners_.push_back(static_cast<std::uint32_t>(first_vertex_ + static_cast<std::size_t>(corners[at])));
      add_cell(type ? *type : types[k] >= 0 && types[k] < 256 ? static_cast<int>(types[k]) : 0);
    }
  }

  void add_cell(int type) {
    const std::size_t n = corners_.size();
    if ((type == triangle && n == 3) || (type == quad && n == 4) || (type == polygon && n >= 3))
      return add_face(corners_);
    if (type == pixel && n == 4) return add_face({{corners_[0], corners_[1], corners_[3], corners_[2]}});
    if (type != strip || n < 3) {
      ++ignored_;
      return;
    }
    for (std::size_t k = 0; k + 2 < n; ++k)  // every second triangle runs the other way
      add_face({{corners_[k], corners_[k + 1 + k % 2], corners_[k + 2 - k % 2]}});
  }

  void add_face(const std::vector<std::uint32_t>& corners) {
    mesh_.faces.push_back({static_cast<std::uint32_t>(mesh_.indices.size()), static_cast<std::uint32_t>(corners.size()),
                           group_->of(cell_), material_->of(cell_)});
    mesh_.indices.insert(mesh_.indices.end(), corners.begin(), corners.end());
  }

  bool poly_data_;
  XmlElement root_;
  VtkArrays arrays_;
  std::uint64_t most_;  ///< of points, cells or corners
  MeshFile mesh_;
  NameList groups_, materials_;
  std::optional<Labels> group_, material_;  ///< of the cells of this piece
  std::size_t first_vertex_ = 0, cell_ = 0, ignored_ = 0;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

MeshFile read_vtk(const std::filesystem::path& file, const std::string& shown) {
  const std::string bytes = read_bytes(file, shown);
  return VtkReader(bytes, core::lower_case(file.extension().string()) == ".vtp", shown).run();
}

}  // namespace interflect::scene::io
