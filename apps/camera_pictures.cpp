#include "apps/camera_pictures.h"

#include "core/error.h"

namespace interflect::apps {

scene::CameraId camera_named(const scene::Scene& scene, const std::string& name) {
  if (scene.cameras.empty()) throw core::InputError(scene.file.string(), "this scene has no camera");
  if (name.empty()) return {0};
  if (const auto id = scene.find_camera(name)) return *id;
  std::string known;
  for (const scene::Camera& camera : scene.cameras) known += (known.empty() ? "" : ", ") + camera.name;
  throw core::InputError("--camera " + name, scene.file.string() + " has " + known);
}

CameraPicture picture_of(const measure::Method& method, const scene::Scene& scene, scene::CameraId camera, Run& run) {
  const int width = scene.camera(camera).width, height = scene.camera(camera).height;
  std::vector<measure::Measurement> asked;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) asked.emplace_back(measure::PixelRadiance{camera, x, y});
  const std::vector<Estimate> found = method.answer(scene, asked, run);
  CameraPicture picture{core::Image(width, height, scene.channels), core::Image(width, height, scene.channels)};
  std::size_t k = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x, ++k)
      for (int c = 0; c < scene.channel_count(); ++c) {
        picture.radiance.at(x, y, c) = static_cast<float>(found[k].value[c]);
        picture.error.at(x, y, c) =
            static_cast<float>(found[k].error_bound[c] + normal_95 * found[k].standard_error[c]);
      }
  return picture;
}

core::Image with_errors(const core::Image& radiance, const core::Image& error) {
  std::vector<std::string> names = radiance.channels;
  for (const std::string& name : radiance.channels) names.push_back(name + ".error");
  core::Image both(radiance.width, radiance.height, names);
  const int channels = static_cast<int>(radiance.channels.size());
  for (int y = 0; y < both.height; ++y)
    for (int x = 0; x < both.width; ++x)
      for (int c = 0; c < channels; ++c) {
        both.at(x, y, c) = radiance.at(x, y, c);
        both.at(x, y, channels + c) = error.at(x, y, c);
      }
  return both;
}

}  // namespace interflect::apps
