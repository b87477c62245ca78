#include "apps/read_scene.h"

#include "core/format.h"
#include "core/log.h"
#include "results/image_file.h"
#include "scene/reader.h"

namespace interflect::apps {

namespace {

scene::Scene read(const std::filesystem::path& file, SceneUse use) {
  scene::Scene scene = scene::read_scene(file, results::read_radiance);
  if (use == SceneUse::light) scene::warn_of_darkness(scene);
  return scene;
}

void say_notes(const scene::Scene& scene) {
  for (const scene::Note& note : scene.repairs) core::log::info(note.line());
  for (const scene::Note& note : scene.warnings) core::log::warning(note.line());
}

}  // namespace

scene::Scene read_and_note(const std::filesystem::path& file, SceneUse use) {
  scene::Scene scene = read(file, use);
  say_notes(scene);
  return scene;
}

scene::Scene read_to_solve(const std::filesystem::path& file, SceneUse use, scene::Twice may_be) {
  scene::Scene scene = read(file, use);
  for (const auto& found : scene::require_each_place_once(scene, may_be))
    scene.warnings.push_back({scene.file.string(), scene::overlap_text(found) + ": that part counts twice"});
  say_notes(scene);
  return scene;
}

std::vector<std::string> lines_of(const std::vector<scene::Note>& notes) {
  std::vector<std::string> lines;
  for (const scene::Note& note : notes) lines.push_back(note.line());
  return lines;
}

std::string box_text(const scene::Scene& scene) {
  const geometry::Box box = scene.box();
  const Vec3 &low = box.min(), &high = box.max(), size = box.sizes();
  return core::format("%.6g x %.6g x %.6g m, from (%.6g, %.6g, %.6g) to (%.6g, %.6g, %.6g)", size.x(), size.y(),
                      size.z(), low.x(), low.y(), low.z(), high.x(), high.y(), high.z());
}

}  // namespace interflect::apps
