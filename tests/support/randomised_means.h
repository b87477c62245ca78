#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "core/sample_sequence.h"
#include "montecarlo/measurement_sampler.h"
#include "tests/support/shapes.h"

/// A measurement by many randomisations of a sample sequence, each growing: what core::convergence_slope takes.
namespace interflect::test {

/// A point of light, 1 W/sr: 1 m above a square table of 1 m, or in the middle of a cube of 1 m that reflects half.
inline scene::Scene table_under_a_point() {
  scene::SceneBuilder builder({"grey"});
  const geometry::PlanarPolygon square{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}, {}};
  builder.add_polygon("table", square, builder.add_material(diffuse("wood", .5, 0)));
  builder.scene().lights.points.push_back({"point", {.3, .4, 1}, Spectrum(1)});
  return builder.finish();
}
inline scene::Scene cube_about_a_point() {
  scene::SceneBuilder builder({"grey"});
  builder.add_box("cube", {Vec3(0, 0, 0), Vec3(1, 1, 1)}, builder.add_material(diffuse("grey", .5, 0)),
                  scene::SceneBuilder::Facing::inward);
  builder.scene().lights.points.push_back({"point", Vec3::Constant(.5), Spectrum(1)});
  return builder.finish();
}

/// A surface that is a quadrangle, measured by its front.
inline measure::PatchIrradiance irradiance_of(const scene::Scene& scene, const std::string& name) {
  for (const scene::SurfaceId id : scene.surface_ids())
    if (scene.surface(id).name == name)
      return {scene::make_patch(id, scene::Side::front, scene.surface(id).outline->outer)};
  throw core::PreconditionError("no surface " + name);
}

/// Numbers of a sequence at the beginning of a path: where it is measured, and six vertices.
inline constexpr std::size_t given_numbers = 2 + 6 * 8;

/// 16, 32, .. 2^last.
inline std::vector<std::uint64_t> powers_of_two(int last) {
  std::vector<std::uint64_t> samples;
  for (int power = 4; power <= last; ++power) samples.push_back(std::uint64_t{1} << power);
  return samples;
}

/// Weighed means [randomisation][which n] of the first n samples, n of `samples`, which grow.
inline std::vector<std::vector<double>> randomised_means(const montecarlo::PathEstimator& paths,
                                                         const montecarlo::MeasurementSampler& sampler,
                                                         const std::string& sequence,
                                                         std::span<const std::uint64_t> samples,
                                                         std::uint32_t randomisations, std::uint64_t seed = 1) {
  const auto numbers = core::make_sequence(sequence, seed);
  std::vector<double> points(samples.back() * given_numbers);
  std::vector<Spectrum> found(samples.back());
  std::vector<std::vector<double>> means(randomisations);
  for (std::uint32_t r = 0; r < randomisations; ++r) {
    numbers->replicate(r)->points(0, given_numbers, points);
    sampler.sample(paths, {seed, r, 0, points, given_numbers}, found);
    double sum = 0;
    std::uint64_t k = 0;
    for (const std::uint64_t n : samples) {
      for (; k < n; ++k) sum += paths.scene().weigh(found[k]);
      means[r].push_back(sum / static_cast<double>(n));
    }
  }
  return means;
}

}  // namespace interflect::test
