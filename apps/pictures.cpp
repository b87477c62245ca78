#include "apps/pictures.h"

#include <algorithm>
#include <cmath>

#include "results/tone_mapping.h"

namespace interflect::apps {
namespace {

constexpr int gap = 8;    ///< pixels between pictures
constexpr int block = 6;  ///< pixels of a side over which differences are averaged

std::vector<std::string> rgb_names() { return {"R", "G", "B"}; }

Spectrum pixel_of(const core::Image& image, int x, int y) {
  Spectrum s;
  for (int c = 0; c < static_cast<int>(image.channels.size()); ++c) s[c] = static_cast<double>(image.at(x, y, c));
  return s;
}

/// White at 0, blue at -1, red at 1.
std::array<double, 3> diverging(double t) {
  t = std::clamp(t, -1.0, 1.0);
  const std::array<double, 3> end = t < 0 ? std::array{0.13, 0.40, 0.67} : std::array{0.70, 0.09, 0.17};
  std::array<double, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c) colour[c] = 1 + std::abs(t) * (end[c] - 1);
  return colour;
}

/// Weighted radiance, mean over square blocks of pixels: a single traced pixel is noise.
core::Image block_means(const scene::Scene& scene, const core::Image& image) {
  core::Image means((image.width + block - 1) / block, (image.height + block - 1) / block, {"Y", "pixels"});
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      means.at(x / block, y / block, 0) += static_cast<float>(scene.weigh(pixel_of(image, x, y)));
      means.at(x / block, y / block, 1) += 1;
    }
  for (int y = 0; y < means.height; ++y)
    for (int x = 0; x < means.width; ++x) means.at(x, y, 0) /= means.at(x, y, 1);
  return means;
}

core::Image difference_picture(const scene::Scene& scene, const core::Image& fem, const core::Image& traced, double full_scale) {
  const core::Image means_fem = block_means(scene, fem), means_traced = block_means(scene, traced);
  core::Image picture(fem.width, fem.height, rgb_names());
  for (int y = 0; y < fem.height; ++y)
    for (int x = 0; x < fem.width; ++x) {
      const auto a = static_cast<double>(means_fem.at(x / block, y / block, 0));
      const auto b = static_cast<double>(means_traced.at(x / block, y / block, 0)), mean = 0.5 * (a + b);
      const auto colour = diverging(mean > 0 ? (a - b) / (mean * full_scale) : 0);
      for (int c = 0; c < 3; ++c) picture.at(x, y, c) = static_cast<float>(colour[static_cast<std::size_t>(c)]);
    }
  return picture;
}

}  // namespace

core::Image as_rgb(const scene::Scene& scene, const core::Image& radiance) {
  core::Image rgb(radiance.width, radiance.height, rgb_names());
  for (int y = 0; y < rgb.height; ++y)
    for (int x = 0; x < rgb.width; ++x) {
      const auto colour = scene.rgb(pixel_of(radiance, x, y));
      for (int c = 0; c < 3; ++c) rgb.at(x, y, c) = static_cast<float>(colour[static_cast<std::size_t>(c)]);
    }
  return rgb;
}

core::Image picture_of(const measure::Method& method, const scene::Scene& scene, scene::CameraId camera, Run& run) {
  core::Image image(scene.camera(camera).width, scene.camera(camera).height, scene.channels);
  std::vector<measure::Measurement> asked;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) asked.emplace_back(measure::PixelRadiance{camera, x, y});
  const std::vector<Estimate> found = method.answer(scene, asked, run);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < scene.channel_count(); ++c)
        image.at(x, y, c) = static_cast<float>(found[static_cast<std::size_t>(y * image.width + x)].value[c]);
  return image;
}

core::Image comparison_picture(const scene::Scene& scene, const core::Image& fem, const core::Image& traced, double full_scale) {
  const core::Image left = as_rgb(scene, fem), right = as_rgb(scene, traced);
  const results::ToneMapping tone{.white = results::white_of(right)};
  return core::side_by_side({results::tone_mapped(left, tone), results::tone_mapped(right, tone),
                             difference_picture(scene, fem, traced, full_scale)}, gap);
}

}  // namespace interflect::apps
