#include <gtest/gtest.h>

#include <cctype>
#include <cstring>

#include "core/random.h"
#include "texts.h"

namespace interflect::scene {
namespace {

using namespace std::string_literals;
using test::Folder;
using test::parsed;
using test::Text;

constexpr const char* white = R"("white": {"reflectance": 0.5, "exitance": 1})";

/// A scene of one mesh file, all of whose materials are white.
Scene scene_of(const Folder& folder, const std::string& file, const std::string& more = "") {
  return parsed({"", white, R"({"file": ")" + file + R"(", "unmapped": "white")" + more + "}"}, folder.path());
}

std::vector<std::string> messages(const std::vector<Note>& notes) {
  std::vector<std::string> out;
  for (const Note& note : notes) out.push_back(note.message);
  return out;
}

template <class T>
std::string bytes_of(const T& value) {
  std::string out(sizeof(T), '\0');
  std::memcpy(out.data(), &value, sizeof(T));
  return out;
}

TEST(MeshFile, obj_coordinates_are_read_to_the_last_bit) {
  const Folder folder;
  core::RandomNumbers numbers(1, 2, 3);
  std::vector<Vec3> given;
  std::string text;
  for (int k = 0; k < 300; ++k) {  // decimals with 17 digits name a double
    given.emplace_back((numbers.next() - 0.5) * std::pow(10, 12 * numbers.next() - 6), numbers.next() * 1e3,
                       numbers.next());
    char line[200];
    std::snprintf(line, sizeof line, "v\t%.17g %.17e  +%.17g\n", given.back().x(), given.back().y(), given.back().z());
    text += line;
    if (k % 3 == 2) text += "f -3 -2 -1\n";
  }
  folder.write("m.obj", text);
  const Scene scene = scene_of(folder, "m.obj");
  ASSERT_EQ(scene.facets.size(), 100u);
  for (std::size_t k = 0; k < 300; ++k) EXPECT_EQ(scene.facets[k / 3].corner[k % 3], given[k]);
}

TEST(MeshFile, obj_grammar_is_understood) {
  const Folder folder;
  folder.write(
      "m.obj",
      "# a comment\r\nmtllib nowhere.mtl\r\nv 0 0 0 # origin\r\nv 1 0 0\r\nv 1 1 \\\r\n0\r\nv 0 1 0\r\nvt 0 0\r\nvn 0 "
      "0 1\r\n"
      "o thing\r\ng left side\r\nusemtl red paint\r\nf 1/1/1 2//1 3/1 # quarter\r\nusemtl blue\r\nf 1 3 4\r\n");
  const Scene scene = scene_of(folder, "m.obj");
  ASSERT_EQ(scene.surfaces.size(), 2u);
  EXPECT_EQ(scene.surfaces[0].name, "left side/red paint");
  EXPECT_EQ(scene.surfaces[1].name, "left side/blue");
  EXPECT_EQ(scene.materials[0].sides, Sides::both);
  EXPECT_TRUE(scene.repairs.empty());
  EXPECT_EQ(scene.facets[0].corner[2], Vec3(1, 1, 0));
}

TEST(MeshFile, names_are_kept_however_long_they_are) {
  const Folder folder;
  const std::string wing(80, 'w');
  folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng " + wing + "1\nf 1 2 3\ng " + wing + "2\nf 1 3 4\n");
  const Scene scene = scene_of(folder, "m.obj");
  ASSERT_EQ(scene.surfaces.size(), 2u);
  EXPECT_EQ(scene.surfaces[0].name, wing + "1");
  EXPECT_EQ(scene.surfaces[1].name, wing + "2");
}

TEST(MeshFile, a_surface_that_is_one_polygon_keeps_its_outline) {
  const Folder folder;
  folder.write(
      "m.obj",
      "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\ng el\nf 1 2 3 4 5 6\ng other\nf 1 2 3\nf 1 3 4\n");
  const Scene scene = scene_of(folder, "m.obj");
  ASSERT_TRUE(scene.surfaces[0].outline.has_value());
  EXPECT_EQ(scene.surfaces[0].outline->outer.size(), 6u);
  EXPECT_DOUBLE_EQ(scene.area(SurfaceId{0}), 3);
  EXPECT_FALSE(scene.surfaces[1].outline.has_value());
}

TEST(MeshFile, concave_faces_keep_their_shape_and_bent_ones_are_counted) {
  const Folder folder;
  folder.write("m.obj",
               "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6\n"
               "v 0 0 5\nv 1 0 5\nv 1 1 5.1\nv 0 1 5\nf 7 8 9 10\n");
  const Scene scene = scene_of(folder, "m.obj");
  EXPECT_EQ(messages(scene.repairs), (std::vector<std::string>{"1 face that is not planar split into triangles: m/2"}));
  double below = 0;
  for (const Facet& f : scene.facets) below += f.corner[0].z() == 0 ? f.area : 0;
  EXPECT_DOUBLE_EQ(below, 3);
}

TEST(MeshFile, repairs_are_counted) {
  const Folder folder;
  folder.write("m.obj",
               "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 0.000001 0 0\n"
               "f 1 2 3\nf 3 1 2\nf 2 1 3\nf 1 2 5\nf 1 1 2\nf 6 3 4\n");
  EXPECT_EQ(messages(scene_of(folder, "m.obj").repairs),
            (std::vector<std::string>{"2 degenerate faces dropped: m/4, m/5", "2 duplicate faces dropped: m/2, m/3"}));
  EXPECT_EQ(scene_of(folder, "m.obj").facets.size(), 2u);
  const Scene welded = scene_of(folder, "m.obj", R"(, "repair": {"weld": 1e-5})");
  EXPECT_EQ(welded.repairs[0].message, "1 vertices welded to others");
  EXPECT_EQ(welded.facets[1].corner[0], Vec3(0, 0, 0));
  const Scene kept = scene_of(folder, "m.obj", R"(, "repair": {"drop_duplicate": false})");
  EXPECT_EQ(kept.facets.size(), 4u);
}

TEST(MeshFile, of_many_repaired_faces_the_first_few_are_named) {
  const Folder folder;
  std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\ng plate\nusemtl tin\nf 1 2 3\n";
  for (int k = 0; k < 4; ++k) text += "f 1 2 2\n";
  folder.write("m.obj", text);
  EXPECT_EQ(messages(scene_of(folder, "m.obj").repairs),
            (std::vector<std::string>{"4 degenerate faces dropped: plate/tin/2, plate/tin/3, plate/tin/4, .."}));
}

// Out and back along the same edges: it has no area, but crosses nothing.
TEST(MeshFile, a_face_that_runs_back_on_itself_is_degenerate) {
  const Folder folder;
  folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nf 1 2 3 2\n");
  EXPECT_EQ(messages(scene_of(folder, "m.obj").repairs), (std::vector<std::string>{"1 degenerate face dropped: m/2"}));
}

// A needle of 1e-9 m where coordinates are rounded to 1e-10 m: cut into quarters it would lie on a line.  At the origin
// it has an area.
TEST(MeshFile, a_needle_that_its_coordinates_do_not_resolve_is_dropped) {
  for (const auto& [shift, facets] : {std::pair{0, 2}, {1000000, 1}}) {
    const Folder folder;
    const std::string x = std::to_string(shift), beyond = std::to_string(shift + 1),
                      bit = std::to_string(shift) + ".000000001";
    folder.write("m.obj", "v " + x + " " + x + " 0\nv " + beyond + " " + x + " 0\nv " + beyond + " " + beyond +
                              " 0\nv " + beyond + " " + bit + " 0\nf 1 2 3\nf 1 2 4\n");
    EXPECT_EQ(scene_of(folder, "m.obj").facets.size(), static_cast<std::size_t>(facets)) << shift;
  }
}

TEST(MeshFile, reversed_twins_of_one_sided_sheets_are_no_duplicates) {
  const Folder folder;
  folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nf 3 2 1\n");
  const Scene scene = parsed({"", R"("white": {"reflectance": 0.5, "exitance": 1, "sides": "front"})",
                              R"({"file": "m.obj", "unmapped": "white"})"},
                             folder.path());
  EXPECT_EQ(scene.facets.size(), 2u);
  EXPECT_TRUE(scene.repairs.empty());
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0].message, "1 face lies on another that faces the other way: m/2");
}

TEST(MeshFile, materials_are_mapped_by_name) {
  const Folder folder;
  folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl Ceil\nf 1 2 3\nusemtl Wall\nf 1 3 4\n");
  const std::string two = R"("white": {"reflectance": 0.5, "exitance": 1}, "grey": {"reflectance": 0.3})";
  const Scene scene =
      parsed({"", two, R"({"file": "m.obj", "materials": {"Ceil": "white", "Wall": "grey", "Floor": "grey"}})"},
             folder.path());
  EXPECT_EQ(scene.material(SurfaceId{0}).name, "white");
  EXPECT_EQ(scene.material(SurfaceId{1}).name, "grey");
  EXPECT_EQ(messages(scene.warnings), (std::vector<std::string>{"no face bears the material 'Floor' that is mapped"}));
}

TEST(MeshFile, transforms_and_units_apply_to_files) {
  const Folder folder;
  folder.write("m.obj", "v 0 0 0\nv 100 0 0\nv 100 100 0\nf 1 2 3\n");
  Text text{
      "", white,
      R"({"file": "m.obj", "unmapped": "white", "transform": {"rotate_deg_xyz": [90, 0, 0], "translate": [0, 0, 100]}})"};
  text.units = "cm";
  const Scene scene = parsed(text, folder.path());
  EXPECT_EQ(scene.facets[0].corner[2], Vec3(1, 0, 2));
  EXPECT_EQ(scene.facets[0].normal, Vec3(0, -1, 0));
}

// Names may be keywords; keywords may be capitals; between solids and facets may be anything.
TEST(MeshFile, stl_texts_are_understood_as_people_write_them) {
  const Folder folder;
  const auto facet = [](const std::string& z) {
    return "facet normal 0 0 1\nouter loop\nvertex 0 0 " + z + "\nvertex +1 0 " + z + "\nvertex 1 1.e0 " + z +
           "\nendloop\nendfacet\n";
  };
  std::string capitals = "SOLID S\n" + facet("0") + "ENDSOLID\n";
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  for (const std::string& text :
       {"solid\n" + facet("0") + "endsolid", "solid a\r\n\r\n" + facet("0") + "end solid a\r\n",
        "solid my endsolid name\n" + facet("0") + "endsolid my facet name\n\n", capitals,
        "solid a\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 1 1 0 endloop endfacet endsolid a"s}) {
    folder.write("m.stl", text);
    const Scene scene = scene_of(folder, "m.stl");
    ASSERT_EQ(scene.facets.size(), 1u) << text;
    EXPECT_EQ(scene.facets[0].corner[2], Vec3(1, 1, 0)) << text;
  }
  folder.write("m.stl", "solid a\n" + facet("0") + "endsolid a\nsolid b\n" + facet("1") + facet("2") +
                            "endsolid b\nsolid empty\nendsolid empty\n");
  const Scene scene = scene_of(folder, "m.stl");
  ASSERT_EQ(scene.surfaces.size(), 2u);
  EXPECT_EQ(scene.surfaces[1].name, "b");
  EXPECT_EQ(scene.facets.size(), 3u);
  EXPECT_TRUE(scene.repairs.empty());
}

TEST(MeshFile, ply_and_stl_are_read_in_single_precision_and_say_so) {
  const Folder folder;
  folder.write("m.ply",
               "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
               "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0.5\n0 1 0.5\n4 "
               "0 1 2 3\n");
  folder.write("m.stl",
               "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 "
               "0.1\nendloop\nendfacet\nendsolid s\n");
  std::string binary(80, ' ');
  binary += bytes_of(std::uint32_t{1});
  for (const float x : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.1f}) binary += bytes_of(x);
  folder.write("b.stl", binary + std::string(2, '\0'));
  for (const char* file : {"m.ply", "m.stl", "b.stl"}) {
    const Scene scene = scene_of(folder, file);
    EXPECT_EQ(messages(scene.warnings),
              (std::vector<std::string>{"coordinates are in single precision, as the format or its reader has them"}));
    EXPECT_GT(scene.facets[0].normal.z(), 0.5);
  }
  EXPECT_EQ(scene_of(folder, "b.stl").facets[0].corner[2].z(), static_cast<double>(0.1f));
  EXPECT_TRUE(scene_of(folder, "m.ply").surfaces[0].outline.has_value());
}

std::string gltf_of_triangle(const std::string& nodes) {
  // Corners (0,0,0), (1,0,0), (0,1,0) as floats in base 64.
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": )" + nodes +
         R"(, "meshes": [{"name": "tri", "primitives": [{"attributes": {"POSITION": 0}}]}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0,0,0], "max": [1,1,0]}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

TEST(MeshFile, gltf_nodes_place_their_meshes) {
  const Folder folder;
  folder.write("m.gltf",
               gltf_of_triangle(R"([{"children": [1], "translation": [0, 0, 5]}, {"mesh": 0, "scale": [2, 2, 2]}])"));
  const Scene scene = scene_of(folder, "m.gltf");
  ASSERT_EQ(scene.facets.size(), 1u);
  EXPECT_EQ(scene.facets[0].corner[1], Vec3(2, 0, 5));
  EXPECT_EQ(scene.facets[0].normal, Vec3::UnitZ());
}

/// A chunk of a GLB file: its size, its kind, its content.
std::string chunk(const std::string& kind, const std::string& content) {
  return bytes_of(static_cast<std::uint32_t>(content.size())) + kind + content;
}

TEST(MeshFile, glb_holds_text_and_corners_in_one_file) {
  std::string text =
      R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
  "meshes": [{"name": "tri", "primitives": [{"attributes": {"POSITION": 0}}]}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36}]})";
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string corners;
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) corners += bytes_of(x);
  const std::string body = chunk("JSON", text) + chunk(std::string("BIN\0", 4), corners);
  const std::string head = "glTF" + bytes_of(std::uint32_t{2}) + bytes_of(static_cast<std::uint32_t>(12 + body.size()));
  const Folder folder;
  folder.write("m.glb", head + body);
  const Scene scene = scene_of(folder, "m.glb");
  ASSERT_EQ(scene.facets.size(), 1u);
  EXPECT_EQ(scene.facets[0].corner[1], Vec3(1, 0, 0));
  EXPECT_EQ(scene.facets[0].corner[2], Vec3(0, 1, 0));
}

TEST(MeshFile, mirrored_nodes_keep_the_front_in_front) {
  const Folder folder;
  folder.write("m.gltf", gltf_of_triangle(R"([{"mesh": 0, "scale": [-1, 1, 1]}])"));
  EXPECT_EQ(scene_of(folder, "m.gltf").facets[0].normal, Vec3::UnitZ());  // mirrored in x, it still looks up
}

}  // namespace
}  // namespace interflect::scene
