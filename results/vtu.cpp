#include "results/vtu.h"

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <map>

#include "core/error.h"
#include "core/format.h"
#include "results/atomic_file.h"

static_assert(std::endian::native == std::endian::little,
              "the .vtu writer writes the machine's own byte order as little-endian");

namespace interflect::results {

namespace {

constexpr std::uint8_t vtk_triangle = 5, vtk_quad = 9, vtk_quadratic_triangle = 22;

struct Grid {
  std::vector<double> points;
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
};

/// Corners that these patches share are written once.
void append(Grid& grid, std::span<const scene::SurfacePatch> patches) {
  std::map<std::array<double, 3>, std::int64_t> known;
  for (const scene::SurfacePatch& patch : patches) {
    for (const Vec3& p : patch.ring()) {
      const auto next = static_cast<std::int64_t>(grid.points.size() / 3);
      const auto [at, fresh] = known.try_emplace({p.x(), p.y(), p.z()}, next);
      if (fresh) grid.points.insert(grid.points.end(), {p.x(), p.y(), p.z()});
      grid.connectivity.push_back(at->second);
    }
    grid.offsets.push_back(static_cast<std::int64_t>(grid.connectivity.size()));
    grid.types.push_back(patch.corners == 3 ? vtk_triangle : vtk_quad);
  }
}

Grid grid_of(const mesh::ElementMesh& mesh, BarePatches bare) {
  Grid grid;
  for (const mesh::ElementMesh::Part& part : mesh.parts()) append(grid, mesh.patches().subspan(part.first, part.count));
  append(grid, bare);
  return grid;
}

Grid grid_of(const mesh::SmoothMesh& mesh) {
  Grid grid;
  for (const Vec3& p : mesh.points) grid.points.insert(grid.points.end(), p.begin(), p.end());
  for (const mesh::SmoothMesh::Triangle& triangle : mesh.triangles) {
    grid.connectivity.insert(grid.connectivity.end(), triangle.begin(), triangle.end());
    grid.offsets.push_back(static_cast<std::int64_t>(grid.connectivity.size()));
    grid.types.push_back(vtk_quadratic_triangle);
  }
  return grid;
}

template <class T>
const char* type_name();
template <>
const char* type_name<double>() {
  return "Float64";
}
template <>
const char* type_name<std::int64_t>() {
  return "Int64";
}
template <>
const char* type_name<std::int32_t>() {
  return "Int32";
}
template <>
const char* type_name<std::uint8_t>() {
  return "UInt8";
}

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

/// Inline binary: the number of bytes (UInt64) and the bytes, in one run of base64.
template <class T>
void append_array(std::string& out, const std::string& name, const std::vector<T>& values, int components,
                  const std::vector<std::string>& component_names = {}) {
  out += core::format("<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\"", type_name<T>(),
                      escaped(name).c_str(), components);
  for (std::size_t c = 0; c < component_names.size(); ++c)
    out += core::format(" ComponentName%zu=\"%s\"", c, escaped(component_names[c]).c_str());
  const std::uint64_t size = values.size() * sizeof(T);
  std::string bytes(sizeof size + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
  out += " format=\"binary\">\n" + base64(bytes) + "\n</DataArray>\n";
}

template <class T>
constexpr T no_value = std::numeric_limits<T>::has_quiet_NaN ? std::numeric_limits<T>::quiet_NaN() : T(-1);

/// @param count  of cells or points; the last `bare` of these may have no value
void append_field(std::string& out, const CellField& field, std::size_t count, std::size_t bare = 0) {
  const auto components = static_cast<std::size_t>(field.components);
  const bool named = field.component_names.empty() || field.component_names.size() == components;
  std::visit(
      [&]<class T>(const std::vector<T>& values) {
        const bool of_all = values.size() == count * components,
                   of_elements = values.size() == (count - bare) * components;
        if (field.components < 1 || !named || !(of_all || of_elements))
          throw core::PreconditionError("vtu: field " + field.name + " does not fit the mesh");
        if (of_all) return append_array(out, field.name, values, field.components, field.component_names);
        std::vector<T> padded = values;
        padded.resize(count * components, no_value<T>);
        append_array(out, field.name, padded, field.components, field.component_names);
      },
      field.values);
}

/// @param bare  how many of the cells, the last ones, have no elements
std::string text_of(const Grid& grid, std::span<const CellField> of_cells, std::span<const CellField> of_points,
                    std::size_t bare = 0) {
  const std::size_t cells = grid.types.size(), points = grid.points.size() / 3;
  std::string out =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "<UnstructuredGrid>\n";
  out += core::format("<Piece NumberOfPoints=\"%zu\" NumberOfCells=\"%zu\">\n<Points>\n", points, cells);
  append_array(out, "Points", grid.points, 3);
  out += "</Points>\n<Cells>\n";
  append_array(out, "connectivity", grid.connectivity, 1);
  append_array(out, "offsets", grid.offsets, 1);
  append_array(out, "types", grid.types, 1);
  out += "</Cells>\n<CellData>\n";
  for (const CellField& field : of_cells) append_field(out, field, cells, bare);
  out += "</CellData>\n";
  if (!of_points.empty()) out += "<PointData>\n";
  for (const CellField& field : of_points) append_field(out, field, points);
  if (!of_points.empty()) out += "</PointData>\n";
  return out + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace

std::string base64(std::string_view bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t have = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < have ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= have ? digits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return out;
}

CellField scalar_field(std::string name, std::vector<double> values) {
  return {std::move(name), std::move(values), 1, {}};
}

CellField spectrum_field(std::string name, std::span<const Spectrum> values, const std::vector<std::string>& channels) {
  std::vector<double> flat;
  flat.reserve(values.size() * channels.size());
  for (const Spectrum& s : values) flat.insert(flat.end(), s.data(), s.data() + channels.size());
  const int components = static_cast<int>(channels.size());
  return {std::move(name), std::move(flat), components, components > 1 ? channels : std::vector<std::string>{}};
}

std::vector<CellField> id_fields(const mesh::ElementMesh& mesh, BarePatches bare) {
  std::vector<std::int64_t> element;
  std::vector<std::int32_t> surface, side;
  const auto add = [&](const scene::SurfacePatch& patch, std::int64_t number) {
    element.push_back(number);
    surface.push_back(static_cast<std::int32_t>(patch.surface.value));
    side.push_back(patch.side == scene::Side::back ? 1 : 0);
  };
  for (const scene::SurfacePatch& patch : mesh.patches()) add(patch, static_cast<std::int64_t>(element.size()));
  for (const scene::SurfacePatch& patch : bare) add(patch, no_value<std::int64_t>);
  return {
      {"element", std::move(element), 1, {}}, {"surface", std::move(surface), 1, {}}, {"side", std::move(side), 1, {}}};
}

std::string vtu_text(const mesh::ElementMesh& mesh, std::span<const CellField> fields, BarePatches bare) {
  return text_of(grid_of(mesh, bare), fields, {}, bare.size());
}

std::string vtu_text(const mesh::SmoothMesh& mesh, std::span<const CellField> of_points) {
  std::vector<std::int64_t> element(mesh.element.begin(), mesh.element.end());
  const CellField of_cells{"element", std::move(element), 1, {}};
  return text_of(grid_of(mesh), {&of_cells, 1}, of_points);
}

void write_vtu(const std::filesystem::path& file, const mesh::ElementMesh& mesh, std::span<const CellField> fields,
               BarePatches bare) {
  write_atomically(file, vtu_text(mesh, fields, bare));
}
void write_vtu(const std::filesystem::path& file, const mesh::SmoothMesh& mesh, std::span<const CellField> of_points) {
  write_atomically(file, vtu_text(mesh, of_points));
}

}  // namespace interflect::results
