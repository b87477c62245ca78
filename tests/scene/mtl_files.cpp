#include <gtest/gtest.h>

#include "texts.h"

// Materials of an OBJ's own MTL files: "unmapped": "mtl".
namespace interflect::scene {
namespace {

using test::complaint;
using test::Folder;
using test::parsed;
using test::Text;

constexpr const char* rgb = R"("channels": ["r", "g", "b"])";
constexpr const char* white = R"("white": {"reflectance": 0.5, "exitance": 1})";
constexpr const char* triangle = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";

/// A scene of one triangle for each material.
Text mesh_of(const Folder& folder, const std::string& mtl, const std::vector<std::string>& materials,
             const std::string& channels = rgb) {
  std::string obj = "mtllib m.mtl\n";
  int z = 0;
  for (const std::string& name : materials) {
    const std::string height = std::to_string(z++) + "\n";
    obj += "usemtl " + name + "\nv 0 0 " + height + "v 1 0 " + height + "v 1 1 " + height + "f -3 -2 -1\n";
  }
  folder.write("m.obj", obj);
  folder.write("m.mtl", mtl);
  return {channels, white, R"({"file": "m.obj", "unmapped": "mtl"})"};
}

/// What a text of one material "a" becomes, and what is left out of it.
struct Read {
  Material material;
  std::string left_out;
};
Read read(const std::string& statements, const std::string& channels = rgb) {
  const Folder folder;
  const Scene scene = parsed(mesh_of(folder, "newmtl a\n" + statements, {"a"}, channels), folder.path());
  const std::string head = "1 material of MTL files without what is not understood: a (";
  std::string left_out;
  for (const Note& note : scene.warnings)
    if (note.message.starts_with(head))
      left_out = note.message.substr(head.size(), note.message.size() - head.size() - 1);
  return {scene.materials.at(0), left_out};
}

std::string said(const std::string& statements, const std::string& channels = rgb) {
  const Folder folder;
  const std::string found = complaint(mesh_of(folder, "newmtl a\n" + statements, {"a"}, channels), folder.path());
  const std::size_t file = found.find("m.mtl");
  return file == std::string::npos ? found : found.substr(file);
}

void expect_spectrum(const Spectrum& found, double r, double g, double b) {
  EXPECT_DOUBLE_EQ(found[0], r);
  EXPECT_DOUBLE_EQ(found[1], g);
  EXPECT_DOUBLE_EQ(found[2], b);
}

TEST(MtlFile, is_diffuse_by_kd_unless_it_says_otherwise) {
  for (const char* more : {"", "illum 0\n", "illum 1\nKs 1 1 1\n", "illum 2\nKs 0 0 0\nNs 10\nNi 1.5\nTf 1 1 1\n"}) {
    const Read found = read(std::string("Ka 1 1 1\nKd 0.6 0.5 0.4 # wood\n") + more);
    EXPECT_TRUE(found.material.is_diffuse()) << more;
    expect_spectrum(found.material.reflectance, .6, .5, .4);
    EXPECT_TRUE(found.material.exitance.is_zero());
    EXPECT_EQ(found.material.sides, Sides::both);
    EXPECT_EQ(found.left_out, "") << more;
  }
}

TEST(MtlFile, knows_mirrors_and_polished_metals) {
  const Read mirror = read("Kd 0 0 0\nKs 0.9 0.8 0.7\nNs 1000\nillum 3\n");
  expect_spectrum(std::get<Mirror>(mirror.material.finish).reflectance, .9, .8, .7);
  EXPECT_EQ(mirror.left_out, "");
  EXPECT_TRUE(mirror.material.reflectance.is_zero());

  const Read metal = read("Ks 0.9 0.8 0.7\nillum 5\n");  // by Fresnel: more at grazing angles
  const Metal& facets = std::get<Metal>(metal.material.finish);
  expect_spectrum(std::get<Spectrum>(facets.reflects), .9, .8, .7);
  EXPECT_EQ(facets.roughness, 0);
  EXPECT_EQ(metal.left_out, "");
}

TEST(MtlFile, knows_metals_by_their_metalness_with_burleys_roughness) {
  const Read found = read("Kd 0.9 0.6 0.3\nKs 0.5 0.5 0.5\nNs 250\nillum 3\nPr 0.4\nPm 1\nPs 0\nPc 0\naniso 0\n");
  const Metal& metal = std::get<Metal>(found.material.finish);
  expect_spectrum(std::get<Spectrum>(metal.reflects), .9, .6, .3);
  EXPECT_DOUBLE_EQ(metal.roughness, .16);
  EXPECT_EQ(found.left_out, "");
}

TEST(MtlFile, knows_clear_bodies) {
  for (const char* more : {"", "Tf 1 1 1\nd 1\nKs 1 1 1\n", "Kd 0 0 0\n"}) {
    const Read found = read(std::string("illum 7\nNi 1.33\n") + more);
    EXPECT_EQ(std::get<Glass>(found.material.finish).index, 1.33) << more;
    EXPECT_EQ(std::get<Glass>(found.material.finish).roughness, 0) << more;
    EXPECT_EQ(found.material.opacity, 1) << more;
    EXPECT_EQ(found.left_out, "") << more;
  }
}

TEST(MtlFile, takes_dissolve_as_opacity) {
  EXPECT_EQ(read("Kd 0.5\nd 0.25\n").material.opacity, .25);
  EXPECT_EQ(read("Ks 0.5\nillum 3\nd 0.25\n").material.opacity, .25);
  EXPECT_EQ(read("Kd 0.5\nd 0.25\nTr 0.75\n").left_out, "");
  EXPECT_EQ(read("Kd 0.5\nTr 0\n").left_out, "");
}

// What may mean two things, or nothing that this program has, is told of, and the rest is diffuse.
TEST(MtlFile, says_what_it_leaves_out) {
  const std::pair<const char*, const char*> cases[] = {
      {"Kd 0.5\nKs 0.3\nNs 20\nillum 2\n", "Ks"},          // a highlight whose energy nobody knows
      {"Kd 0.5\nKs 0.3\n", "Ks"},                          // the same: no model is the second
      {"Kd 0.5\nKs 0.9\nillum 3\n", "Ks"},                 // half a mirror
      {"Kd 0.5\nPm 0.5\nPr 0.2\n", "Pm, Pr"},              // half a metal
      {"Kd 0.5\nPm 1\n", "Pm"},                            // how rough?
      {"Kd 0.5\nPm 0\nPr 0.2\n", "Pr"},                    // a rough coat
      {"Kd 0.5\nillum 4\nd 0.5\n", "illum 4"},             // glass that does not refract
      {"Kd 0.5\nillum 6\nNi 1.5\n", "illum 6"},            // refracts, and reflects nothing: no such body
      {"Kd 0.5\nillum 7\nNi 1.5\n", "illum 7"},            // clear and diffuse at once
      {"Kd 0\nillum 7\nNi 1\n", "illum 7"},                // what exporters write who say nothing
      {"Kd 0\nillum 7\nNi 1.5\nTf 0.9 1 1\n", "illum 7"},  // tinted inside
      {"Kd 0\nillum 7\nNi 1.5\nd 0.5\n", "illum 7"},       // refracts, and lets light straight through
      {"Kd 0.5\nillum 9\n", "illum 9"},
      {"Kd 0.5\nKe 17 12 4\n", "Ke"},
      {"Kd 0.5\nTr 0.3\n", "Tr"},
      {"Kd 0.5\nd -halo 0.5\n", "d -halo"},
      {"Kd 0.5\nmap_Kd -s 1 1 1 wood.png\nbump bump.png\nmap_Kd other.png\n", "map_Kd, bump"},
      {"Kd 0.5\nPc 1\nKm 0.05\n", "Pc, Km"}};
  for (const auto& [statements, left_out] : cases) {
    const Read found = read(statements);
    EXPECT_EQ(found.left_out, left_out) << statements;
    EXPECT_TRUE(std::holds_alternative<Lambertian>(found.material.finish)) << statements;
  }
}

// At most a twentieth of what is kept.
TEST(MtlFile, leaves_out_a_trace_of_diffuse_light_and_says_so) {
  const Read mirror = read("Kd 0.01 0.01 0.01\nKs 0.95 0.95 0.95\nillum 5\n");
  EXPECT_TRUE(std::holds_alternative<Metal>(mirror.material.finish));
  EXPECT_EQ(mirror.left_out, "Kd");
  EXPECT_TRUE(std::holds_alternative<Lambertian>(read("Kd 0.06\nKs 0.95\nillum 5\n").material.finish));
  const Read glass = read("Kd 0.05\nNi 1.5\nillum 7\n");
  EXPECT_TRUE(std::holds_alternative<Glass>(glass.material.finish));
  EXPECT_EQ(glass.left_out, "Kd");
}

TEST(MtlFile, refuses_what_no_surface_can_do) {
  const std::string map = R"( (the scene's "materials" may map 'a' to one of its own))";
  const std::pair<const char*, std::string> cases[] = {
      {"Kd 1 1 1\n", "m.mtl:2: a reflectance of 1 is not below 1" + map},
      {"illum 2\nKd 0.5 -0.1 0\n", "m.mtl:3: Kd: -0.1 is outside 0..1" + map},
      {"Ks 1.5\nillum 3\n", "m.mtl:2: Ks: 1.5 is outside 0..1" + map},
      {"Kd 0.5 0.5\n", "m.mtl:2: Kd: one number or three are expected" + map},
      {"Kd spectral wood.rfl 1\n", "m.mtl:2: Kd: 'spectral' is not a finite number" + map},
      {"Kd 0.5 nan 0.5\n", "m.mtl:2: Kd: 'nan' is not a finite number" + map},
      {"Ks 1 1 1\n", "m.mtl:1: the material has no Kd" + map},
      {"Kd 0.5\nd 2\n", "m.mtl:3: d: 2 is outside 0..1" + map},
      {"Kd 0.5\nPm 1\nPr 2\n", "m.mtl:4: Pr: 2 is outside 0..1" + map}};
  for (const auto& [statements, expected] : cases) EXPECT_EQ(said(statements), expected);
  EXPECT_EQ(said("Kd 0.5 0.4 0.3\n", R"("channels": ["red", "blue"])"),
            "m.mtl:2: Kd: a colour is of red, green and blue, and the scene has the channel 'red'" + map);
}

TEST(MtlFile, colours_find_their_channels) {
  const Read turned = read("Kd 0.1 0.2 0.3\n", R"("channels": ["B", "r", "G"])");
  expect_spectrum(turned.material.reflectance, .3, .1, .2);
  const Read one = read("Kd 0.1 0.2 0.3\n", R"("channels": ["y"])");
  EXPECT_DOUBLE_EQ(one.material.reflectance[0], .2126 * .1 + .7152 * .2 + .0722 * .3);
  const Read grey = read("Kd 0.3 0.3 0.3\n", R"("channels": ["red", "blue"])");
  EXPECT_EQ(grey.material.reflectance[0], .3);
  EXPECT_EQ(grey.material.reflectance[1], .3);
}

TEST(MtlFile, gives_way_to_what_the_scene_maps_and_is_counted) {
  const Folder folder;
  Text text =
      mesh_of(folder, "newmtl one\nKd 0.1\nKe 1\nnewmtl lamp\nKd 2\nnewmtl two\nKd 0.2\nKs 1\nnewmtl one\nKd 0.9\n",
              {"one", "lamp", "two"});
  text.geometry = R"({"file": "m.obj", "materials": {"lamp": "white"}, "unmapped": "mtl"},
                     {"file": "m.obj", "materials": {"lamp": "white"}, "unmapped": "mtl",
                      "transform": {"translate": [0, 0, 10]}})";
  const Scene scene = parsed(text, folder.path());
  ASSERT_EQ(scene.materials.size(), 3u);  // of both copies together
  EXPECT_EQ(scene.material(SurfaceId{1}).name, "white");
  EXPECT_EQ(scene.material(SurfaceId{3}).reflectance[0], .1);  // the first of a name
  std::size_t said = 0;
  for (const Note& note : scene.warnings)
    said += note.message == "2 materials of MTL files without what is not understood: one (Ke), two (Ks)";
  EXPECT_EQ(said, 1u);
}

TEST(MtlFile, is_found_beside_its_mesh_under_any_name) {
  const Folder folder;
  std::filesystem::create_directory(folder.path() / "sub");
  folder.write("sub/my walls.mtl", "newmtl red paint\nKd 0.5 0.1 0.1\n");
  folder.write("sub/second.mtl", "newmtl red paint\nKd 0.9\nnewmtl blue\r\nKd 0.1 0.1 0.5\r\n");
  folder.write("sub/m.obj", std::string("mtllib my walls.mtl\nmtllib\tsecond.mtl third.mtl\n") + triangle +
                                "usemtl  red paint \nf 1 2 3\nusemtl blue\nf 1 3 2\n");
  const Text text{rgb, white, R"({"file": "sub/m.obj", "unmapped": "mtl"})"};
  const Scene scene = parsed(text, folder.path());  // third.mtl does not exist, and is not asked
  EXPECT_EQ(scene.material(SurfaceId{0}).reflectance[0], .5);
  EXPECT_EQ(scene.material(SurfaceId{1}).reflectance[2], .5);
}

TEST(MtlFile, says_what_is_missing) {
  const Folder folder;
  Text text = mesh_of(folder, "Kd 1\n", {"a"});
  EXPECT_TRUE(complaint(text, folder.path()).ends_with("m.mtl:1: 'Kd' stands before the first material (newmtl NAME)"));
  folder.write("m.mtl", "newmtl b\nKd 0.5\n");
  EXPECT_EQ(
      complaint(text, folder.path()),
      "s.json:6: /geometry/0: materials of the file without one of the scene or of its MTL files: 'a' (map them in "
      "\"materials\", or name one as \"unmapped\")");
  std::filesystem::remove(folder.path() / "m.mtl");
  const std::string found = complaint(text, folder.path());
  EXPECT_TRUE(found.starts_with((folder.path() / "m.obj").string() + ": there is no file '")) << found;
  EXPECT_TRUE(found.ends_with("m.mtl', which its mtllib names")) << found;
  text.materials += R"(, "mtl": {"reflectance": 0.1})";
  EXPECT_TRUE(complaint(text, folder.path())
                  .ends_with("the scene has a material 'mtl': is that meant, or the mesh's MTL files?"));
  text = {rgb, white, R"({"file": "m.stl", "unmapped": "mtl"})"};
  folder.write("m.stl",
               "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 "
               "0\nendloop\nendfacet\nendsolid a\n");
  EXPECT_TRUE(
      complaint(text, folder.path()).ends_with("MTL files belong to OBJ files: a material of the scene is expected"));
}

// data/scenes/cornell_mcguire.json copied the reflectances by hand.
TEST(MtlFile, of_the_shipped_box_says_what_its_scene_says) {
  const std::filesystem::path data = INTERFLECT_SOURCE_DIR "/data";
  const Scene copied = read_scene(data / "scenes/cornell_mcguire.json");
  const Text text{R"("up": "y", "channels": ["r", "g", "b"])", R"("lamp": {"reflectance": 0.78, "exitance": 1})",
                  R"({"file": "meshes/CornellBox-Original.obj", "materials": {"light": "lamp"}, "unmapped": "mtl"})"};
  const Scene read = parsed(text, data);
  ASSERT_EQ(read.surfaces.size(), copied.surfaces.size());
  for (const SurfaceId id : read.surface_ids()) {
    EXPECT_EQ(read.surface(id).name, copied.surface(id).name);
    EXPECT_TRUE(read.material(id).is_diffuse());
    for (int c = 0; c < 3; ++c) EXPECT_EQ(read.material(id).reflectance[c], copied.material(id).reflectance[c]);
  }
}

}  // namespace
}  // namespace interflect::scene
