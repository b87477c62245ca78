#include "results/tone_mapping.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace interflect::results {

double weighted_quantile(std::span<const double> values, std::span<const double> weights, double part) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i])) order.push_back(i);
  if (order.empty()) return 0;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  const auto weight = [&](std::size_t i) { return weights.empty() ? 1.0 : weights[i]; };
  const double total =
      std::accumulate(order.begin(), order.end(), 0.0, [&](double sum, std::size_t i) { return sum + weight(i); });
  double below = 0;
  for (std::size_t i : order)
    if ((below += weight(i)) >= part * total) return values[i];
  return values[order.back()];
}

core::Image as_rgb(const scene::Scene& scene, const core::Image& radiance) {
  core::Image rgb(radiance.width, radiance.height, {"R", "G", "B"});
  for (int y = 0; y < rgb.height; ++y)
    for (int x = 0; x < rgb.width; ++x) {
      const auto colour = scene.rgb(radiance.pixel(x, y));
      for (int c = 0; c < 3; ++c) rgb.at(x, y, c) = static_cast<float>(colour[static_cast<std::size_t>(c)]);
    }
  return rgb;
}

double white_of(const core::Image& image) {
  std::vector<double> brightest;
  for (std::size_t at = 0; at < image.data.size(); at += image.channels.size()) {
    const auto pixel = std::span(image.data).subspan(at, image.channels.size());
    brightest.push_back(*std::max_element(pixel.begin(), pixel.end()));
  }
  return std::max(0.0, weighted_quantile(brightest, {}, 0.99));
}

double srgb_encoded(double linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 1;
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

core::Image tone_mapped(const core::Image& image, const ToneMapping& tone) {
  const double bright = tone.white > 0 ? tone.white : white_of(image), white = bright > 0 ? bright : 1;
  core::Image out = image;
  std::transform(image.data.begin(), image.data.end(), out.data.begin(),
                 [white](float v) { return static_cast<float>(srgb_encoded(v / white)); });
  return out;
}

}  // namespace interflect::results
