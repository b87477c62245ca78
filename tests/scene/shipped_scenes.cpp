#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "scene/inspection.h"
#include "scene/reader.h"

namespace interflect::scene {
namespace {

std::vector<std::filesystem::path> shipped_scenes() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(INTERFLECT_SOURCE_DIR "/data/scenes"))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Those that are made of other people's meshes, with the faults that their comments tell of.
bool is_of_a_mesh(const Scene& scene) { return !scene.repairs.empty(); }

TEST(ShippedScenes, all_are_read_with_a_light_and_a_camera) {
  const auto files = shipped_scenes();
  EXPECT_GE(files.size(), 5u);
  for (const auto& file : files) {
    SCOPED_TRACE(file.filename().string());
    const Scene scene = read_scene(file);
    EXPECT_TRUE(scene.emitted_flux().max() > 0 || !scene.lights.empty());
    EXPECT_FALSE(scene.cameras.empty());
    std::set<std::string> names;
    for (const Surface& surface : scene.surfaces) EXPECT_TRUE(names.insert(surface.name).second) << surface.name;
  }
}

TEST(ShippedScenes, our_own_have_no_warnings_flipped_normals_or_overlaps) {
  for (const auto& file : shipped_scenes()) {
    SCOPED_TRACE(file.filename().string());
    const Scene scene = read_scene(file);
    if (is_of_a_mesh(scene)) continue;
    for (const Note& note : scene.warnings) ADD_FAILURE() << note.place << ": " << note.message;
    using Kind = Inspection::Finding::Kind;
    for (const auto& f : inspect(scene).findings)  // a pane stands free
      EXPECT_TRUE(f.kind == Kind::gap || f.kind == Kind::rim) << describe(f.kind) << " " << f.surface << " " << f.other;
  }
}

TEST(ShippedScenes, rooms_are_closed) {
  for (const char* name :
       {"office.json", "two_rooms.json", "furnace.json", "concentric_cubes.json", "cube.json", "sphere.json"}) {
    const std::filesystem::path file = std::filesystem::path(INTERFLECT_SOURCE_DIR "/data/scenes") / name;
    if (!std::filesystem::exists(file)) continue;
    EXPECT_TRUE(inspect(read_scene(file)).closed()) << name;
  }
}

}  // namespace
}  // namespace interflect::scene
