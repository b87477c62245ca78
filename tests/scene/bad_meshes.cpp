#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "texts.h"

namespace interflect::scene {
namespace {

using namespace std::string_literals;
using test::complaint;
using test::Folder;

/// What is said of a mesh file, without the folder before its name.
std::string said_of(const std::string& name, const std::string& bytes,
                    const std::string& more = R"(, "unmapped": "white")") {
  const Folder folder;
  folder.write(name, bytes);
  std::string said =
      complaint({"", R"("white": {"reflectance": 0.5})", R"({"file": ")" + name + "\"" + more + "}"}, folder.path());
  const std::string prefix = folder.path().string() + "/";
  if (said.starts_with(prefix)) said.erase(0, prefix.size());
  return said;
}

const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";

TEST(BadMesh, obj_faults_name_their_line) {
  EXPECT_EQ(said_of("m.obj", corners + "f 1 2 4\n"), "m.obj:4: a face refers to vertex 4, and 3 are defined so far");
  EXPECT_EQ(said_of("m.obj", corners + "f 1 2 -4\n"), "m.obj:4: a face refers to vertex -4, and 3 are defined so far");
  EXPECT_EQ(said_of("m.obj", corners + "f 1 2 0\n"),
            "m.obj:4: a face has an index that is 0 or no number: they start at 1");
  EXPECT_EQ(said_of("m.obj", corners + "f 1 2 x\n"),
            "m.obj:4: a face has an index that is 0 or no number: they start at 1");
  EXPECT_EQ(said_of("m.obj", corners + "f 1 2 4294967297\n"), "m.obj:4: a face has an index beyond a thousand million");
  EXPECT_EQ(said_of("m.obj", corners + "f 1 2 3\nf 1 2"), "m.obj:5: a face has three corners or more, not 2");
  EXPECT_EQ(said_of("m.obj", corners + "f 1 2 3\nf"), "m.obj:5: a face has three corners or more, not 0");
  EXPECT_EQ(said_of("m.obj", "v 0 0 0\nv 1 nan 0\n"), "m.obj:2: the coordinate 'nan' is not finite");
  EXPECT_EQ(said_of("m.obj", "v 0 0 0\n\nv 1 0 -inf\n"), "m.obj:3: the coordinate '-inf' is not finite");
  EXPECT_EQ(said_of("m.obj", "v 0 0 0\nv 1 0 1e999\n"), "m.obj:2: '1e999' is not a coordinate");
  EXPECT_EQ(said_of("m.obj", "v 0 0 0\nv 1 0\n"), "m.obj:2: a vertex has three coordinates");
  EXPECT_EQ(said_of("m.obj", "v 0 0 0\rv 1 one 0\r"), "m.obj:1: 'one' is not a coordinate");
}

TEST(BadMesh, files_without_faces_are_refused) {
  EXPECT_EQ(said_of("m.obj", ""), "m.obj: the file has no faces");
  EXPECT_EQ(said_of("m.obj", corners), "m.obj: the file has points or lines, and no faces");
  EXPECT_EQ(said_of("m.obj", corners + "p 1\nl 1 2\n"), "m.obj: the file has points or lines, and no faces");
  EXPECT_EQ(said_of("m.obj", corners + "f 1 1 2\n"), "m.obj: no face with an area is left");
  EXPECT_EQ(said_of("m.ply", ""), "m.ply: the file is empty");
  EXPECT_EQ(said_of("m.stl", "solid a\nendsolid a\n"), "m.stl: the file has no faces");
}

TEST(BadMesh, degenerate_faces_are_an_error_where_they_may_not_be_dropped) {
  EXPECT_EQ(said_of("m.obj", corners + "f 1 2 3\nf 1 1 2\n",
                    R"(, "unmapped": "white", "repair": {"drop_degenerate": false})"),
            "m.obj: the face m/2 has no area (\"drop_degenerate\" would drop it)");
}

// With loops of two sizes, of one size, whose areas cancel, and out of plane.
TEST(BadMesh, faces_that_cross_themselves_are_refused_by_name) {
  const std::string said = " crosses itself: what it encloses is not defined; are its corners in order?";
  for (const char* face : {"v 0 0 8\nv 4 0 8\nv 4 3 8\nv 1 -1 8\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n",
                           "v 0 0 0\nv 0 1 0.3\nv 1 0 0\nv 2 2 0\nv 1 0.9 0\n"}) {
    const std::string corner_list = std::count(face, face + std::strlen(face), 'v') == 4 ? "4 5 6 7" : "4 5 6 7 8";
    EXPECT_EQ(said_of("m.obj", corners + face + "g box\nf 1 2 3\nf " + corner_list + "\n"),
              "m.obj: the face box/2" + said)
        << face;
  }
}

// Its cubes and squares would overflow; of a kilometre in millimetres none does.
TEST(BadMesh, coordinates_out_of_reach_name_their_vertex) {
  EXPECT_EQ(said_of("m.obj", corners + "v 1 2 -1e100\nf 1 2 3\n"),
            "m.obj: vertex 4 lies at (1, 2, -1e+100) m: at most 1e+15 m from 0 along each axis expected");
  EXPECT_EQ(said_of("m.obj", corners + "f 1 2 3\n", R"(, "unmapped": "white", "transform": {"scale": 1e-30})"),
            "s.json: its surfaces are 1.4e-30 m across, all together: 1e-15 m or more expected; in which unit are its "
            "coordinates?");
  EXPECT_EQ(said_of("m.obj", corners + "f 1 2 3\n", R"(, "unmapped": "white", "transform": {"scale": 1e100})"),
            "m.obj: vertex 2 lies at (1e+100, 0, 0) m: at most 1e+15 m from 0 along each axis expected");
  EXPECT_EQ(said_of("m.obj", "v 1e15 0 0\nv 0 1e15 0\nv 0 0 1e15\nf 1 2 3\n"), "read");
}

TEST(BadMesh, unmapped_materials_are_listed) {
  const std::string text = corners + "usemtl Ceil\nf 1 2 3\nusemtl Wall\nf 1 3 2\n";
  EXPECT_EQ(said_of("m.obj", text, ""),
            "s.json:5: /geometry/0: materials of the file without one of the scene: 'Ceil', 'Wall' (map them in "
            "\"materials\", or "
            "name one as \"unmapped\")");
  EXPECT_EQ(said_of("m.obj", text, R"(, "materials": {"Ceil": "white"}, "unmapped": "error")"),
            "s.json:5: /geometry/0: materials of the file without one of the scene: 'Wall' (map them in \"materials\", "
            "or name one as "
            "\"unmapped\")");
  EXPECT_EQ(said_of("m.obj", text, R"(, "materials": {"Ceil": "whit"}, "unmapped": "white")"),
            "s.json:5: /geometry/0/materials/Ceil: the material 'whit' is not known: did you mean 'white'?");
}

TEST(BadMesh, names_of_materials_are_looked_up_before_a_face_asks_for_them) {
  const std::string text = corners + "usemtl Ceil\nf 1 2 3\n";
  EXPECT_EQ(said_of("m.obj", text, R"(, "materials": {"Ceil": "white"}, "unmapped": "alsonot")"),
            "s.json:5: /geometry/0/unmapped: the material 'alsonot' is not known: one of white is expected");
  EXPECT_EQ(said_of("m.obj", text, R"(, "materials": {"Ceil": "white", "Typo": "nosuch"})"),
            "s.json:5: /geometry/0/materials/Typo: the material 'nosuch' is not known: one of white is expected");
}

TEST(BadMesh, a_weld_below_rounding_is_refused_where_it_stands) {
  EXPECT_EQ(said_of("m.obj", corners + "f 1 2 3\n", R"(, "unmapped": "white", "repair": {"weld": 1e-300})"),
            "s.json:5: /geometry/0/repair/weld: a weld of less than 1e-15 of the coordinates is below their rounding");
}

TEST(BadMesh, unknown_formats_are_named) {
  EXPECT_EQ(said_of("m.3ds", "x"),
            "m.3ds: the mesh format '.3ds' is not known: one of .obj, .ply, .stl, .gltf, .glb, .vtu, .vtp is expected");
  EXPECT_EQ(said_of("m.gtlf", "x"), "m.gtlf: the mesh format '.gtlf' is not known: did you mean '.gltf'?");
}

TEST(BadMesh, foreign_encodings_are_named) {
  EXPECT_EQ(said_of("m.obj", "\xFF\xFEv\0 \0"s), "m.obj: the file is in UTF-16: UTF-8 is expected");
  EXPECT_EQ(said_of("m.obj", corners + "f 1\0 2 3\n"s), "m.obj:4: a NUL byte: text in UTF-8 is expected");
}

TEST(BadMesh, headers_that_promise_more_than_there_is_are_refused) {
  EXPECT_EQ(
      said_of("m.ply",
              "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n"
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n"),
      "m.ply: the header promises 4000000001 elements, in 6 bytes");
  EXPECT_EQ(said_of("m.ply", "plx\n"), "m.ply: this is not a PLY file: it does not begin with 'ply'");
  EXPECT_EQ(said_of("m.ply", "ply\nformat ascii 1.0\nend_header-1"), "m.ply: the PLY header has no end");
  EXPECT_EQ(said_of("m.ply", "ply\nformat ascii 1.0\nelement face 1\nproperty fld\nend_header\n0\n"),
            "m.ply: the PLY header's line 'property fld' is not understood");
  EXPECT_EQ(said_of("m.ply", "ply\nformat ascii 1.0\n"), "m.ply: the PLY header has no end");
  EXPECT_EQ(said_of("m.stl", std::string(80, ' ') + "\xFF\xFF\xFF\xFF"),
            "m.stl: the header promises 4294967295 triangles, in 84 bytes");
  EXPECT_EQ(said_of("m.stl", "nothing"), "m.stl: 7 bytes are too few for an STL file");
  EXPECT_EQ(said_of("m.glb", "glTF\2\0\0\0\xFF\xFF\xFF\x7F\0\0\0\0JSON"s),
            "m.glb: the file is shorter than its header says");
}

TEST(BadMesh, gltf_texts_that_lie_are_refused) {
  const std::string head = R"({"asset": {"version": "2.0"}, )";
  EXPECT_EQ(said_of("m.gltf", head + R"("buffers": [{"byteLength": 4000000000}]})"),
            "m.gltf: a buffer promises more bytes than the files hold");
  EXPECT_EQ(said_of("m.gltf", head + R"("buffers": [{"byteLength": 36, "uri": "nowhere.bin"}]})"),
            "m.gltf: the buffer 'nowhere.bin' cannot be read");
  EXPECT_EQ(said_of("m.gltf", head + R"("accessors": [{"count": 4000000000}]})"),
            "m.gltf: 'count' in 'accessors' exceeds the buffers");
  EXPECT_EQ(said_of("m.gltf", head + R"("accessors": [{"count": -1}]})"),
            "m.gltf: 'count' in 'accessors' is not a whole number");
  EXPECT_EQ(said_of("m.gltf", head + R"("nodes": [{"children": [1]}, {"children": [0]}]})"),
            "m.gltf: nodes hold each other in a ring");
  EXPECT_EQ(said_of("m.gltf", head + R"("nodes": [{"children": [7]}]})"),
            "m.gltf: node 0 has a child that does not exist");
  EXPECT_EQ(said_of("m.gltf", "[" + std::string(100000, '[')), "m.gltf: nested deeper than 200 levels");
  std::string chain;
  for (int k = 1; k < 2000; ++k) chain += R"({"children": [)" + std::to_string(k) + "]}, ";
  EXPECT_EQ(said_of("m.gltf", head + "\"nodes\": [" + chain + "{}]}"), "m.gltf: nodes are nested deeper than 500");
}

TEST(BadMesh, gltf_accessors_stay_within_their_buffers) {
  const auto said = [](const std::string& view, const std::string& accessor) {
    return said_of("m.gltf",
                   R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 3, "uri": "data:;base64,AAAA"}],
        "bufferViews": [{"buffer": 0, )" +
                       view + R"(}], "accessors": [{"componentType": 5121, "type": "SCALAR", )" + accessor + "}]}");
  };
  EXPECT_EQ(said(R"("byteLength": 4)", R"("count": 1)"), "m.gltf: a buffer view reaches beyond its buffer");
  EXPECT_EQ(said(R"("byteLength": 2, "byteOffset": 2)", R"("count": 1)"),
            "m.gltf: a buffer view reaches beyond its buffer");
  EXPECT_EQ(said(R"("byteLength": 3)", R"("bufferView": 0, "count": 4)"),
            "m.gltf: an accessor reaches beyond its buffer view");
  EXPECT_EQ(said(R"("byteLength": 3)", R"("bufferView": 1, "count": 1)"),
            "m.gltf: an accessor names a buffer view that does not exist");
  EXPECT_EQ(said(R"("byteLength": 3)", R"("bufferView": 0, "count": 3, "sparse": {"count": 4})"),
            "m.gltf: a sparse accessor changes more than it has");
}

// Cut anywhere but within the last number, which may be one of fewer digits.
TEST(BadMesh, ply_texts_that_are_cut_are_refused) {
  const std::string whole =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 1\n3 0 1 2\n3 0 2 3";
  const std::size_t data = whole.find("end_header\n") + 11;
  for (std::size_t length = data; length + 1 < whole.size(); ++length) {
    const std::string said = said_of("m.ply", whole.substr(0, length));
    EXPECT_TRUE(said.starts_with("m.ply: the data end within the elements '") ||
                said.starts_with("m.ply: a list of ") || said.starts_with("m.ply: the header promises "))
        << said << "\n"
        << whole.substr(data, length - data);
  }
}

TEST(BadMesh, stl_texts_that_are_cut_are_refused) {
  const std::string facet =
                        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n",
                    whole = "solid two words\n" + facet + facet + "endsolid two words\n";
  const std::size_t name = whole.find("\n"), end = whole.rfind("endsolid") + 8;
  for (std::size_t length = name; length < end; ++length) {
    const std::string said = said_of("m.stl", whole.substr(0, length));
    EXPECT_TRUE(said.starts_with("m.stl:")) << length << ": " << said;
  }
  for (std::size_t length = end; length <= whole.size(); ++length)
    EXPECT_EQ(said_of("m.stl", whole.substr(0, length)), "read") << length;
  EXPECT_EQ(said_of("m.stl", "solid two words\n" + facet),
            "m.stl:9: the file ends within the solid 'two words': 'endsolid' is expected");
  EXPECT_EQ(said_of("m.stl", "solid a\n" + facet + facet.substr(0, 60)), "m.stl:13: the file ends within a facet");
  EXPECT_EQ(said_of("m.stl", "solid a\n" + facet + facet.substr(0, 60) + "\nendsolid a\n"),
            "m.stl:14: the solid ends within a facet");
  EXPECT_EQ(said_of("m.stl", "solid a\n" + facet.substr(0, 56) + "endloop\nendfacet\nendsolid a\n"),
            "m.stl:6: a facet has three corners, not 2");
  EXPECT_EQ(said_of("m.stl", "solid a\n" + facet.substr(0, 53) + "\nendloop\nendfacet\nendsolid a\n"),
            "m.stl:5: a vertex has three coordinates");
}

TEST(BadMesh, ply_lists_stay_within_their_file) {
  const auto header = [](const std::string& format) {
    return "ply\nformat " + format + " 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n" +
           "element face 1\nproperty list uint int vertex_indices\nend_header\n";
  };
  EXPECT_EQ(said_of("m.ply", header("binary_little_endian") + std::string(12, '\0') + "\xFF\xFF\xFF\xFF" +
                                 std::string(12, '\0')),
            "m.ply: the data end within the elements 'face'");
  EXPECT_EQ(said_of("m.ply", header("binary_big_endian") + std::string(12, '\0') + "\0\0\0\4"s + std::string(12, '\0')),
            "m.ply: the data end within the elements 'face'");
  EXPECT_EQ(said_of("m.ply", header("binary_little_endian") + std::string(8, '\0')),
            "m.ply: the data end within the elements 'vertex'");
  EXPECT_EQ(said_of("m.ply", header("ascii") + "0 0 0\n4000000000 0 0 0\n"),
            "m.ply: a list of the elements 'face' promises more than its line holds");
}

TEST(BadMesh, every_truncation_is_read_or_refused_in_one_line) {
  const std::string text = corners + "g a\nusemtl b\nf 1/1/1 2//2 3\n";
  for (std::size_t length = 0; length <= text.size(); ++length)
    EXPECT_EQ(said_of("m.obj", text.substr(0, length)).find("MORE"), std::string::npos);
  std::string binary(80, ' ');
  binary += "\2\0\0\0"s + std::string(100, '\1');
  for (std::size_t length = 0; length <= binary.size(); length += 7)
    EXPECT_EQ(said_of("m.stl", binary.substr(0, length)).find("MORE"), std::string::npos);
}

}  // namespace
}  // namespace interflect::scene
