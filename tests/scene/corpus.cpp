#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "core/error.h"
#include "scene/io/mesh_import.h"
#include "scene/io/mesh_reader.h"
#include "scene/reader.h"

namespace interflect::scene {
namespace {

class Corpus : public testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("INTERFLECT_CORPUS");
    if (!folder || !*folder) GTEST_SKIP() << "INTERFLECT_CORPUS is not set: tests on other people's meshes are skipped";
    root_ = folder;
  }

  std::vector<std::filesystem::path> files(const std::string& folder) const {
    std::vector<std::filesystem::path> out;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root_ / folder))
      if (entry.is_regular_file()) out.push_back(entry.path());
    std::sort(out.begin(), out.end());
    return out;
  }

  static Scene load(const std::filesystem::path& file) {
    io::MeshFile mesh = io::read_mesh(file, file.string());
    SceneBuilder builder({"y"});
    const MaterialId grey = builder.add_material({"grey", Spectrum(0.5), Spectrum(), Sides::both});
    io::place_vertices(mesh, {}, file.string());
    io::weld_vertices(mesh, 0);
    io::import_mesh(builder, mesh, std::vector<MaterialId>(mesh.materials.size(), grey), {}, file.string());
    return builder.finish();
  }

  std::filesystem::path root_;
};

TEST_F(Corpus, every_file_is_read_or_refused_in_one_line_that_names_it) {
  std::size_t read = 0, refused = 0;
  for (const char* folder : {"messy", "cornell-mcguire", "holodeck-mcguire"})
    for (const auto& file : files(folder)) {
      SCOPED_TRACE(file.string());
      try {
        const Scene scene = load(file);
        ++read;
        EXPECT_FALSE(scene.facets.empty());
        EXPECT_TRUE(scene.box().min().allFinite() && scene.box().max().allFinite());
        for (const Facet& facet : scene.facets) {
          ASSERT_GE(facet.area, 0);
          ASSERT_NEAR(facet.normal.norm(), 1, 1e-12);
        }
      } catch (const core::InputError& error) {
        ++refused;
        const std::string what = error.what();
        EXPECT_TRUE(what.starts_with(file.string())) << what;
        EXPECT_EQ(what.find('\n'), std::string::npos) << what;
        EXPECT_LT(what.size(), file.string().size() + 400) << what;
      }
    }
  EXPECT_GT(read, 60u);
  EXPECT_GT(refused, 40u);
}

TEST_F(Corpus, mcguires_boxes_have_all_their_vertices) {
  const std::vector<std::pair<std::string, std::size_t>> counts{
      {"CornellBox-Empty-RG.obj", 24}, {"CornellBox-Original.obj", 72}, {"CornellBox-Mirror.obj", 72}};
  for (const auto& [name, vertices] : counts) {
    const auto file = root_ / "cornell-mcguire" / name;
    if (!std::filesystem::exists(file)) continue;
    const io::MeshFile mesh = io::read_mesh(file, name);
    EXPECT_EQ(mesh.vertices.size(), vertices) << name;
    // Quads with corners of their own, named by negative indices from the latest vertex on.
    EXPECT_EQ(mesh.indices.size(), vertices) << name;
    EXPECT_EQ(mesh.faces.size(), vertices / 4) << name;
  }
}

TEST_F(Corpus, duplicated_faces_of_the_original_box_are_counted) {
  const Scene scene = load(root_ / "cornell-mcguire/CornellBox-Original.obj");
  ASSERT_FALSE(scene.repairs.empty());
  EXPECT_TRUE(scene.repairs[0].message.starts_with("2 duplicate faces dropped: ")) << scene.repairs[0].message;
}

TEST_F(Corpus, what_each_trap_is_for_is_what_is_said) {
  const std::vector<std::pair<std::string, std::string>> traps{
      {"assimp-testmodels/OBJ/box_UTF16BE.obj", ": the file is in UTF-16: UTF-8 is expected"},
      {"assimp-testmodels/OBJ/point_cloud.obj", ": the file has points or lines, and no faces"},
      {"assimp-testmodels/invalid/malformed.obj", ":23: a face refers to vertex 12, and 8 are defined so far"},
      {"assimp-testmodels/OBJ/box_longline.obj",
       ": the face 1/Defauli/1 crosses itself: what it encloses is not defined; are its corners in order?"},
      {"trimesh-messy/models/notenoughindices.obj", ":9: a face has three corners or more, not 2"},
      {"assimp-testmodels/glTF2/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", ": vertex 1 is not finite"},
      {"assimp-testmodels/glTF2/RecursiveNodes/RecursiveNodes.gltf", ": nodes hold each other in a ring"},
      {"assimp-testmodels/glTF2/MissingBin/BoxTextured.gltf", ": the buffer 'BoxTextured0.bin' cannot be read"}};
  for (const auto& [name, said] : traps) {
    const std::string file = (root_ / "messy" / name).string();
    try {
      load(file);
      ADD_FAILURE() << file << " was read";
    } catch (const core::InputError& error) {
      EXPECT_EQ(error.what(), file + said);
    }
  }
}

TEST_F(Corpus, a_hole_that_a_double_edge_joins_stays_open) {
  const Scene scene = load(root_ / "messy/assimp-testmodels/OBJ/concave_polygon.obj");
  EXPECT_TRUE(scene.repairs.empty());
  EXPECT_EQ(scene.facets.size(), 64u);
}

/// A mesh with the materials of its MTL files; what is left out of them is said in warnings.
class CorpusMaterials : public Corpus {
 protected:
  Scene load_with_mtl(const std::string& folder, const std::string& file, const std::string& mapped = "{}") const {
    return parse_scene(R"({"format": "interflect/scene/1", "units": "m", "channels": ["r", "g", "b"],
                           "materials": {"lamp": {"reflectance": 0.7, "exitance": 1}},
                           "geometry": [{"file": ")" +
                           file + R"(", "unmapped": "mtl", "materials": )" + mapped + "}]}",
                       "s.json", root_ / folder);
  }
  static const Material& named(const Scene& scene, const std::string& name) {
    return *std::find_if(scene.materials.begin(), scene.materials.end(),
                         [&](const Material& m) { return m.name == name; });
  }
  static std::string left_out(const Scene& scene) {
    for (const Note& note : scene.warnings)
      if (note.message.find("of MTL files") != std::string::npos) return note.message;
    return "";
  }
};

TEST_F(CorpusMaterials, mcguires_mirror_is_one) {
  const Scene scene = load_with_mtl("cornell-mcguire", "CornellBox-Mirror.obj", R"({"light": "lamp"})");
  const Metal& mirror = std::get<Metal>(named(scene, "tallBox").finish);
  EXPECT_EQ(std::get<Spectrum>(mirror.reflects)[1], .95);
  EXPECT_EQ(mirror.roughness, 0);
  EXPECT_TRUE(named(scene, "shortBox").is_diffuse());
  EXPECT_EQ(left_out(scene), "1 material of MTL files without what is not understood: tallBox (Kd)");
}

// Their bodies of glass keep a tenth of the light that passes (Tf): no clear ones.
TEST_F(CorpusMaterials, mcguires_grey_glass_is_not_taken_for_clear) {
  const Scene scene = load_with_mtl("cornell-mcguire", "CornellBox-Sphere.obj", R"({"light": "lamp"})");
  EXPECT_TRUE(std::holds_alternative<Metal>(named(scene, "leftSphere").finish));
  EXPECT_TRUE(named(scene, "rightSphere").is_diffuse());
  const std::string said = left_out(scene);
  EXPECT_NE(said.find("rightSphere (illum 7)"), std::string::npos) << said;
}

TEST_F(CorpusMaterials, every_mtl_file_is_read_or_refused_in_one_line) {
  std::size_t read = 0, refused = 0;
  for (const char* folder : {"cornell-mcguire", "holodeck-mcguire", "messy"})
    for (const auto& file : files(folder)) {
      if (file.extension() != ".obj") continue;
      SCOPED_TRACE(file.string());
      try {
        for (const Material& m : load_with_mtl(file.parent_path().string(), file.filename().string()).materials) {
          for (int c = 0; c < 3; ++c) EXPECT_GE(m.reflectance[c], 0);
          EXPECT_LT(m.reflectance.max(), 1);
          EXPECT_TRUE(m.exitance.is_zero());
        }
        ++read;
      } catch (const core::InputError& error) {
        ++refused;
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      }
    }
  EXPECT_GT(read, 5u);
  EXPECT_GT(refused, 10u);
}

}  // namespace
}  // namespace interflect::scene
