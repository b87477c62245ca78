#include "bench/picture_efficiency.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "bench/bare_embree.h"
#include "core/run.h"
#include "montecarlo/render.h"

namespace interflect::bench {
namespace {

constexpr int size = 128;
constexpr std::uint64_t reference_samples = 2048;
constexpr int pictures = 5;

montecarlo::Rendering picture(const scene::Scene& scene, const raycast::RayCaster& caster, const std::string& sequence,
                              std::uint64_t samples, std::uint64_t seed, unsigned threads) {
  montecarlo::RenderSettings settings;
  settings.samples = samples;
  settings.sequence = sequence;
  core::LocalRun run(seed, threads);
  return montecarlo::render(scene, scene::CameraId{0}, settings, run, caster);
}

double weighed(const scene::Scene& scene, const core::Image& image, int x, int y) {
  Spectrum s;
  for (int c = 0; c < scene.channel_count(); ++c) s[c] = static_cast<double>(image.at(x, y, c));
  return scene.weigh(s);
}

/// Weighed radiance of the pixels that see anything, and its variance.
struct Reference {
  struct Pixel {
    int x, y;
    double value, variance;
  };
  std::vector<Pixel> pixels;
  double mean = 0;

  Reference(const scene::Scene& scene, const montecarlo::Rendering& by) {
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const double value = weighed(scene, by.radiance, x, y), error = weighed(scene, by.standard_error, x, y);
        if (value > 0) pixels.push_back({x, y, value, error * error});
        mean += value / (size * size);
      }
  }
  /// Of a picture, e² and what the mean square is over the square of the mean.
  struct Squares {
    double relative = 0, over_mean = 0;
  };
  Squares squares(const scene::Scene& scene, const core::Image& radiance) const {
    Squares sum;
    for (const Pixel& r : pixels) {
      const double difference = weighed(scene, radiance, r.x, r.y) - r.value, scale = std::max(r.value, 0.1 * mean),
                   square = (difference * difference - r.variance) / static_cast<double>(pixels.size());
      sum.relative += square / (scale * scale);
      sum.over_mean += square / (mean * mean);
    }
    return sum;
  }
};

void print_line(const scene::Scene& scene, const raycast::RayCaster& caster, const Reference& reference,
                const std::string& sequence, std::uint64_t samples) {
  Reference::Squares e;
  std::vector<double> cpu;
  for (std::uint64_t seed = 1; seed <= pictures; ++seed) {
    const std::clock_t before = std::clock();
    const montecarlo::Rendering made = picture(scene, caster, sequence, samples, seed, 1);
    cpu.push_back(static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
    const Reference::Squares of_one = reference.squares(scene, made.radiance);
    e.relative += of_one.relative / pictures, e.over_mean += of_one.over_mean / pictures;
  }
  std::printf(
      "  %-12s %4llu samples a pixel, %5.2f CPU s: relative RMSE %5.2f %%, efficiency %5.1f / s  (RMSE over mean %.1f "
      "%%, %.1f / s)\n",
      sequence.c_str(), static_cast<unsigned long long>(samples), median(cpu), 100 * std::sqrt(e.relative),
      1 / (e.relative * median(cpu)), 100 * std::sqrt(e.over_mean), 1 / (e.over_mean * median(cpu)));
}

}  // namespace

void print_picture_efficiency(const scene::Scene& given) {
  scene::Scene scene = given;
  scene.cameras.at(0).width = scene.cameras[0].height = size;
  const auto caster = raycast::make_ray_caster("embree", scene);
  const Reference reference(scene, picture(scene, *caster, "independent", reference_samples, 1000, 0));
  std::printf("%d x %d pixels of camera '%s', %zu of them see something; efficiency 1 / (relative RMSE² x CPU s):\n",
              size, size, scene.cameras[0].name.c_str(), reference.pixels.size());
  for (const char* sequence : {"independent", "zero-two", "sobol-owen"})
    for (const std::uint64_t samples : {64, 256}) print_line(scene, *caster, reference, sequence, samples);
}

}  // namespace interflect::bench
