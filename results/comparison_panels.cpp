#include "results/comparison_panels.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "results/colour_map.h"
#include "results/tone_mapping.h"

namespace interflect::results {

namespace {

constexpr int block = BlocksApart::side;
constexpr double standard_errors = 3;  // up to which a block stays white

/// A picture's means over blocks: its weighted value, or, of a picture of independent standard errors, that of the
/// mean.
struct Blocks {
  Blocks(int width, int height) : across(number_of(width)), mean(across * number_of(height)) {}
  static std::size_t number_of(int pixels) { return static_cast<std::size_t>((pixels + block - 1) / block); }
  std::size_t of(int x, int y) const {
    return static_cast<std::size_t>(y / block) * across + static_cast<std::size_t>(x / block);
  }
  double at(int x, int y) const { return mean[of(x, y)]; }

  std::size_t across;
  std::vector<double> mean;
};

std::vector<int> pixels_of(const Blocks& blocks, const core::Image& image) {
  std::vector<int> pixels(blocks.mean.size(), 0);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) ++pixels[blocks.of(x, y)];
  return pixels;
}

Blocks block_means(const scene::Scene& scene, const core::Image& image) {
  Blocks blocks(image.width, image.height);
  const std::vector<int> pixels = pixels_of(blocks, image);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      blocks.mean[blocks.of(x, y)] += scene.weigh(image.pixel(x, y)) / pixels[blocks.of(x, y)];
  return blocks;
}

/// sqrt(sum SE^2) / pixels.  A pixel's channels stem from the same paths: their errors add up as if they were one.
Blocks block_noise(const scene::Scene& scene, const core::Image& noise) {
  Blocks blocks(noise.width, noise.height);
  const std::vector<int> pixels = pixels_of(blocks, noise);
  for (int y = 0; y < noise.height; ++y)
    for (int x = 0; x < noise.width; ++x) {
      const double error = scene.weigh(noise.pixel(x, y)) / pixels[blocks.of(x, y)];
      blocks.mean[blocks.of(x, y)] += error * error;
    }
  for (double& variance : blocks.mean) variance = std::sqrt(variance);
  return blocks;
}

/// 0 where noise may be all, as where both are dark.
double relative_difference(double fem, double traced, double noise) {
  const double mean = 0.5 * (fem + traced);
  return std::abs(fem - traced) > standard_errors * noise && mean > 0 ? (fem - traced) / mean : 0;
}

/// Relative differences of blocks.
Blocks differences(const scene::Scene& scene, const core::Image& fem, const core::Image& traced, const Blocks& error) {
  const Blocks a = block_means(scene, fem), b = block_means(scene, traced);
  Blocks differences(fem.width, fem.height);
  for (std::size_t k = 0; k < differences.mean.size(); ++k)
    differences.mean[k] = relative_difference(a.mean[k], b.mean[k], error.mean[k]);
  return differences;
}

/// Where both are dark, or nothing is known of an error, nothing can differ.
std::size_t blocks_that_may_differ(const scene::Scene& scene, const core::Image& fem, const core::Image& traced,
                                   const Blocks& error) {
  const Blocks a = block_means(scene, fem), b = block_means(scene, traced);
  std::size_t blocks = 0;
  for (std::size_t k = 0; k < error.mean.size(); ++k)
    blocks += a.mean[k] + b.mean[k] > 0 && error.mean[k] > 0 && std::isfinite(error.mean[k]);
  return blocks;
}

BlocksApart apart(const Blocks& differences, std::size_t blocks) {
  BlocksApart apart{blocks};
  for (const double difference : differences.mean) apart.brighter += difference > 0, apart.darker += difference < 0;
  return apart;
}

core::Image difference_panel(const core::Image& fem, const Blocks& differences, double full_scale) {
  core::Image picture(fem.width, fem.height, {"R", "G", "B"});
  for (int y = 0; y < fem.height; ++y)
    for (int x = 0; x < fem.width; ++x) {
      const Colour colour = colour_of(ColourMap::blue_white_red, 0.5 + 0.5 * differences.at(x, y) / full_scale);
      for (int c = 0; c < 3; ++c)
        picture.at(x, y, c) = static_cast<float>(colour[static_cast<std::size_t>(c)]) / 255.0F;
    }
  return picture;
}

}  // namespace

/// The least number that a binomial one is above with a probability of no more than `level`.
std::size_t BlocksApart::by_chance() const {
  constexpr double level = 0.005, allowance = 2;
  const double p = allowance * 0.5 * std::erfc(standard_errors / std::sqrt(2.0)), n = static_cast<double>(blocks);
  double below = 0;
  for (std::size_t count = 0; count < blocks; ++count) {
    const auto k = static_cast<double>(count);
    below += std::exp(std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1) + k * std::log(p) +
                      (n - k) * std::log1p(-p));
    if (below >= 1 - level) return count;
  }
  return blocks;
}

/// Of the one that is brighter in places, those may be single samples of rare light, beside which all else is black.
static double shared_white(const core::Image& left, const core::Image& right) {
  const double a = white_of(left), b = white_of(right);
  return a > 0 && b > 0 ? std::min(a, b) : std::max(a, b);
}

ComparisonPanels comparison_panels(const scene::Scene& scene, const core::Image& fem, const core::Image& traced,
                                   const core::Image& noise, double full_scale, const core::Image* shared_error) {
  const auto same_size = [&](const core::Image& other) {
    return other.width == fem.width && other.height == fem.height;
  };
  if (!same_size(traced) || !same_size(noise) || !(full_scale > 0) ||
      (shared_error != nullptr && !same_size(*shared_error)))
    throw core::PreconditionError("comparison_panels: pictures of one size and a scale above 0 expected");
  Blocks error = block_noise(scene, noise);
  if (shared_error != nullptr) {
    const Blocks shared = block_means(scene, *shared_error);
    for (std::size_t k = 0; k < error.mean.size(); ++k) error.mean[k] = std::hypot(error.mean[k], shared.mean[k]);
  }
  const core::Image left = as_rgb(scene, fem), right = as_rgb(scene, traced);
  const ToneMapping tone{.white = shared_white(left, right)};
  const Blocks apart_by = differences(scene, fem, traced, error);
  return {tone_mapped(left, tone), tone_mapped(right, tone), difference_panel(fem, apart_by, full_scale),
          apart(apart_by, blocks_that_may_differ(scene, fem, traced, error))};
}

}  // namespace interflect::results
