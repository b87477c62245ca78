#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>

#include "geometry_texts.h"

namespace interflect::scene {
namespace {

using test::geometry_of;
using test::groups_of;
using test::names_of;
using test::said_of_geometry;
using Names = std::vector<std::string>;

std::string vtu(const std::string& connectivity, const std::string& offsets, const std::string& types,
                const std::string& data = "", const std::string& points = "9") {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
         points + "\" NumberOfCells=\"" + std::to_string(std::count(types.begin(), types.end(), ' ') + 1) +
         "\">\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n"
         "0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 0 0 2 0 1 2 0 2 2 0.1\n</DataArray>\n</Points>\n<Cells>\n"
         "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">" +
         connectivity + "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" + offsets +
         "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" + types +
         "</DataArray>\n</Cells>\n<CellData>\n" + data + "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

std::string cells(const std::string& name, const std::string& values) {
  return "<DataArray type=\"Int32\" Name=\"" + name + "\" format=\"ascii\">" + values + "</DataArray>\n";
}

TEST(VtkFile, polygons_of_every_kind_become_surfaces_and_their_cell_data_groups) {
  // A triangle, a quad, a pixel, a polygon of six corners, a strip of three triangles, and a line.
  const ExchangeScene read = geometry_of(
      "m.vtu",
      vtu("0 1 3  1 2 5 4  3 4 6 7  0 1 2 5 4 3  3 4 6 7 8  0 1", "3 7 11 17 22 24", "5 9 8 7 6 3",
          cells("surface", "0 1 1 2 3 3") + cells("temperature", "1 2 3 4 5 6") + cells("material", "7 7 7 7 7 7")));
  EXPECT_EQ(groups_of(read),
            (Names{"surface-0/material-7", "surface-1/material-7", "surface-1/material-7", "surface-2/material-7",
                   "surface-3/material-7", "surface-3/material-7", "surface-3/material-7"}));
  EXPECT_EQ(names_of(read)[2], "surface-1/material-7/3");
  const double areas[] = {0.5, 1, 1, 2, 0.5, 0.5};
  for (std::uint32_t k = 0; k < 6; ++k) {
    EXPECT_DOUBLE_EQ(read.scene.area(SurfaceId{k}), areas[k]) << k;
    EXPECT_EQ(read.scene.facets_of(SurfaceId{k})[0].normal, Vec3::UnitZ()) << k;
  }
  EXPECT_EQ(read.scene.repairs[0].message, "1 cell that is no polygon ignored");
  EXPECT_TRUE(read.scene.warnings.empty()) << "doubles are kept";
  EXPECT_EQ(read.scene.facets_of(SurfaceId{6})[0].corner[2].z(), 0.1);
}

TEST(VtkFile, poly_data_is_read) {
  const ExchangeScene read = geometry_of(
      "m.vtp",
      "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData><Piece NumberOfPoints=\"4\" "
      "NumberOfVerts=\"1\" NumberOfLines=\"0\" NumberOfStrips=\"1\" NumberOfPolys=\"1\"><Points><DataArray "
      "type=\"Float32\" "
      "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 1 1 0 0 1 0</DataArray></Points>"
      "<Verts><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0</DataArray>"
      "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">1</DataArray></Verts>"
      "<Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>"
      "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4</DataArray></Polys>"
      "<Strips><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 3 1</DataArray>"
      "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray></Strips>"
      "<CellData><DataArray type=\"Int32\" Name=\"surface\" format=\"ascii\">5 6 7</DataArray></CellData>"
      "</Piece></PolyData></VTKFile>");
  EXPECT_EQ(names_of(read), (Names{"surface-6", "surface-7"}));
  EXPECT_DOUBLE_EQ(read.scene.area(SurfaceId{0}), 1);
  EXPECT_EQ(read.scene.warnings.size(), 1u) << "of single precision";
}

std::string base64_of(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t all = 0;
    for (std::size_t k = 0; k < 3; ++k)
      all = all << 8 | (at + k < bytes.size() ? static_cast<unsigned char>(bytes[at + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += at + k <= bytes.size() ? digits[all >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

template <class T>
std::string bytes_of(std::initializer_list<T> values, bool swapped = false) {
  std::string out;
  for (const T value : values) {
    std::string one(sizeof(T), '\0');
    std::memcpy(one.data(), &value, sizeof(T));
    if (swapped) std::reverse(one.begin(), one.end());
    out += one;
  }
  return out;
}

/// How arrays are written.
struct Encoding {
  bool appended = false, base64 = true, zlib = false, big_endian = false;
};

/// A unit square and a triangle beside it, 0.1 high at its tip.
std::string encoded_vtu(const Encoding& e) {
  std::string appended;
  const auto array = [&](const std::string& head, const std::string& bytes) {
    const auto header = [&](std::initializer_list<std::uint32_t> numbers) { return bytes_of(numbers, e.big_endian); };
    std::string out;
    if (e.zlib) {  // two blocks
      const std::size_t block = (bytes.size() + 1) / 2;
      std::string parts[2];
      for (std::size_t k = 0; k < 2; ++k) {
        const std::string plain = bytes.substr(k * block, block);
        parts[k].resize(::compressBound(plain.size()));
        uLongf length = parts[k].size();
        ::compress(reinterpret_cast<Bytef*>(parts[k].data()), &length, reinterpret_cast<const Bytef*>(plain.data()),
                   plain.size());
        parts[k].resize(length);
      }
      const auto size = [](std::size_t s) { return static_cast<std::uint32_t>(s); };
      const std::string sizes =
          header({2, size(block), size(bytes.size() - block), size(parts[0].size()), size(parts[1].size())});
      out = e.base64 ? base64_of(sizes) + base64_of(parts[0] + parts[1]) : sizes + parts[0] + parts[1];
    } else {
      const std::string all = header({static_cast<std::uint32_t>(bytes.size())}) + bytes;
      out = e.base64 ? base64_of(all) : all;
    }
    if (!e.appended) return "<DataArray " + head + " format=\"binary\">\n  " + out + "\n</DataArray>\n";
    const std::string place = std::to_string(appended.size());
    appended += out;
    return "<DataArray " + head + " format=\"appended\" offset=\"" + place + "\"/>\n";
  };
  const bool swapped = e.big_endian;
  std::string text = std::string("<VTKFile type=\"UnstructuredGrid\" byte_order=\"") + (swapped ? "Big" : "Little") +
                     "Endian\"" + (e.zlib ? " compressor=\"vtkZLibDataCompressor\"" : "") +
                     "><UnstructuredGrid><Piece NumberOfPoints='5' NumberOfCells='2'><Points>";
  text += array("type='Float64' NumberOfComponents='3'",
                bytes_of<double>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0.1}, swapped));
  text += "</Points><Cells>";
  text += array("type='Int32' Name='connectivity'", bytes_of<std::int32_t>({0, 1, 2, 3, 1, 4, 2}, swapped));
  text += array("type='Int64' Name='offsets'", bytes_of<std::int64_t>({4, 7}, swapped));
  text += array("type='UInt8' Name='types'", bytes_of<std::uint8_t>({9, 5}, swapped));
  text += "</Cells><CellData>" + array("type='UInt16' Name='surface'", bytes_of<std::uint16_t>({300, 7}, swapped)) +
          "</CellData></Piece></UnstructuredGrid>";
  if (e.appended)
    text += std::string("<AppendedData encoding='") + (e.base64 ? "base64" : "raw") + "'>_" + appended +
            "\n</AppendedData>";
  return text + "</VTKFile>\n";
}

std::vector<Encoding> encodings() {
  std::vector<Encoding> out;
  for (const bool appended : {false, true})
    for (const bool base64 : {true, false})
      for (const bool zlib : {false, true})
        for (const bool big_endian : {false, true})
          if (appended || base64) out.push_back({appended, base64, zlib, big_endian});
  return out;
}

TEST(VtkFile, every_encoding_gives_the_same_numbers) {
  for (const Encoding& e : encodings()) {
    const ExchangeScene read = geometry_of("m.vtu", encoded_vtu(e));
    ASSERT_EQ(names_of(read), (Names{"surface-300", "surface-7"}));
    EXPECT_DOUBLE_EQ(read.scene.area(SurfaceId{0}), 1);
    EXPECT_EQ(read.scene.facets_of(SurfaceId{1})[0].corner[1], Vec3(2, 0, 0.1)) << "to the last bit";
  }
}

TEST(VtkFile, texts_name_groups) {
  const ExchangeScene read = geometry_of(
      "m.vtu", vtu("0 1 3 1 2 5 4", "3 7", "5 9",
                   "<Array type=\"String\" Name=\"group\" format=\"ascii\">108 105 100 0 119 97 108 108 0</Array>"));
  EXPECT_EQ(names_of(read), (Names{"lid", "wall"}));
}

TEST(VtkFile, pieces_come_one_after_the_other) {
  std::string text = vtu("0 1 3", "3", "5");
  const std::size_t start = text.find("<Piece"), end = text.find("</UnstructuredGrid>");
  text.insert(end, text.substr(start, end - start));
  const ExchangeScene read = geometry_of("m.vtu", text);
  EXPECT_EQ(read.scene.repairs[0].message, "1 duplicate face dropped: m/2") << "it is the same triangle again";
}

TEST(VtkFile, faults_name_their_line) {
  const auto said = [](const std::string& text) { return said_of_geometry("m.vtu", text); };
  EXPECT_EQ(said(vtu("0 1 3", "3", "5")), "read");
  EXPECT_EQ(said(""), "m.vtu:1: an XML element is expected");
  EXPECT_EQ(said("# vtk DataFile Version 2.0\n"), "m.vtu:2: an XML element is expected");
  EXPECT_EQ(said("<html></html>"), "m.vtu:1: a <VTKFile> with <UnstructuredGrid> is expected");
  EXPECT_EQ(said_of_geometry("m.vtp", vtu("0 1 3", "3", "5")), "m.vtp:2: a <VTKFile> with <PolyData> is expected");
  EXPECT_EQ(said(vtu("0 1 3", "3", "5").substr(0, 500)), "m.vtu:13: '=' is expected behind 'ty'");
  EXPECT_EQ(said(vtu("0 1 3", "3", "5").substr(0, 480)), "m.vtu:12: the end of 'DataArray' is expected");
  EXPECT_EQ(said(vtu("0 1", "2", "3")), "m.vtu: the file has points or lines, and no faces");
  EXPECT_EQ(said(vtu("0 1 9", "3", "5")), "m.vtu:11: a cell refers to point 9 of 9, which count from 0");
  EXPECT_EQ(said(vtu("0 1 -1", "3", "5")), "m.vtu:11: a cell refers to point -1 of 9, which count from 0");
  EXPECT_EQ(said(vtu("0 1 x", "3", "5")), "m.vtu:11: 3 numbers are expected, not 0");
  EXPECT_EQ(said(vtu("0 1 3", "4", "5")), "m.vtu:11: 4 numbers are expected, not 3");
  EXPECT_EQ(said(vtu("0 1 3 0 1 3", "6 3", "5 5")), "m.vtu:12: offsets of cells ascend, within what the file can hold");
  EXPECT_EQ(said(vtu("0 1 3", "1e300", "5")), "m.vtu:12: offsets of cells ascend, within what the file can hold");
  EXPECT_EQ(said(vtu("0 1 3", "3", "5", "", "4000000000")), "m.vtu:4: NumberOfPoints is more than the file can hold");
  EXPECT_EQ(said(vtu("0 1 3", "3", "5", "", "-1")), "m.vtu:4: NumberOfPoints is not a count");
  EXPECT_EQ(said(vtu("0 1 3", "3", "5", cells("surface", "1 2"))), "m.vtu:16: 1 numbers are expected, not 2");
  EXPECT_EQ(said("<VTKFile compressor='vtkLZ4DataCompressor'/>"),
            "m.vtu:1: its data are compressed by 'vtkLZ4DataCompressor': zlib, or none, is expected");
  std::string deep;
  for (int k = 0; k < 100000; ++k) deep += "<a>";
  EXPECT_EQ(said(deep), "m.vtu:1: nested deeper than 32 levels");
}

TEST(VtkFile, every_truncation_and_changed_letter_is_read_or_refused_in_one_line) {
  std::vector<std::string> texts{vtu("0 1 3  1 2 5 4", "3 7", "5 9", cells("surface", "0 1"))};
  for (const Encoding& e : encodings())
    if (!e.big_endian) texts.push_back(encoded_vtu(e));
  for (const std::string& text : texts) {
    for (std::size_t length = 0; length <= text.size(); length += 31)
      EXPECT_EQ(said_of_geometry("m.vtu", text.substr(0, length)).find("MORE"), std::string::npos);
    for (std::size_t at = 0; at < text.size(); at += 13)
      for (const char c : {'9', '\xFF'}) {
        std::string changed = text;
        changed[at] = changed[at] == c ? '1' : c;
        EXPECT_EQ(said_of_geometry("m.vtu", changed).find("MORE"), std::string::npos);
      }
  }
}

}  // namespace
}  // namespace interflect::scene
