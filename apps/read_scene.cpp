#include "apps/read_scene.h"

#include "core/format.h"
#include "core/log.h"
#include "scene/reader.h"

namespace interflect::apps {

scene::Scene read_and_note(const std::filesystem::path& file, SceneUse use) {
  scene::Scene scene = scene::read_scene(file);
  if (use == SceneUse::light) scene::warn_of_darkness(scene);
  for (const scene::Note& note : scene.repairs) core::log::info(note.line());
  for (const scene::Note& note : scene.warnings) core::log::warning(note.line());
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
