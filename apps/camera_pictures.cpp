#include "apps/camera_pictures.h"

#include <algorithm>

#include "core/error.h"
#include "core/log.h"

namespace interflect::apps {

scene::CameraId camera_named(const scene::Scene& scene, const std::string& name) {
  if (scene.cameras.empty()) throw core::InputError(scene.file.string(), "this scene has no camera");
  if (name.empty()) return {0};
  if (const auto id = scene.find_camera(name)) return *id;
  std::string known;
  for (const scene::Camera& camera : scene.cameras) known += (known.empty() ? "" : ", ") + camera.name;
  throw core::InputError("--camera " + name, scene.file.string() + " has " + known);
}

std::vector<scene::CameraId> drawable_cameras(const scene::Scene& scene) {
  std::vector<scene::CameraId> drawable;
  for (std::uint32_t c = 0; c < scene.cameras.size(); ++c)
    if (const scene::Camera& camera = scene.cameras[c]; camera.is_pinhole())
      drawable.push_back({c});
    else
      core::log::warning("camera '" + camera.name + "': elements are drawn by pinholes only, not by the projection '" +
                         camera.projection_name() + "'");
  return drawable;
}

std::optional<scene::Camera> drawable_camera(const scene::Scene& scene) {
  const auto first =
      std::find_if(scene.cameras.begin(), scene.cameras.end(), [](const auto& c) { return c.is_pinhole(); });
  if (first == scene.cameras.end()) return {};
  return *first;
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
  core::Image named = error;
  named.channels.clear();
  for (const std::string& name : radiance.channels) named.channels.push_back(name + ".error");
  return with_channels(radiance, named);
}

core::Image with_errors_and_samples(const montecarlo::Rendering& rendering) {
  return with_channels(with_errors(rendering.radiance, rendering.standard_error), rendering.samples_a_pixel);
}

core::Image with_channels(const core::Image& image, const core::Image& more) {
  std::vector<std::string> names = image.channels;
  names.insert(names.end(), more.channels.begin(), more.channels.end());
  core::Image both(image.width, image.height, names);
  const int of_image = static_cast<int>(image.channels.size());
  for (int y = 0; y < both.height; ++y)
    for (int x = 0; x < both.width; ++x)
      for (int c = 0; c < static_cast<int>(names.size()); ++c)
        both.at(x, y, c) = c < of_image ? image.at(x, y, c) : more.at(x, y, c - of_image);
  return both;
}

}  // namespace interflect::apps
