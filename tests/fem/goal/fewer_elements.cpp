#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "fem/goal/adaptive_elements.h"
#include "measure/sensor_points.h"
#include "scene/reader.h"

namespace interflect::fem {
namespace {

/// How many elements have this error, by a power law between the passes before and after.
double elements_with(double error, std::span<const AdaptivePass> passes) {
  for (std::size_t k = 1; k < passes.size(); ++k) {
    const AdaptivePass &before = passes[k - 1], &after = passes[k];
    if (after.relative > error || before.relative <= error) continue;
    const double part = std::log(before.relative / error) / std::log(before.relative / after.relative);
    return double(before.elements) * std::pow(double(after.elements) / double(before.elements), part);
  }
  ADD_FAILURE() << "no passes about " << error;
  return 0;
}

// The mean of a plane behind a door that is ajar: elements made for it against uniform ones of degree 2 and of degree
// 1, at the same estimated error.  About three minutes.
TEST(AdaptiveElements, are_five_times_fewer_than_uniform_ones) {
  const scene::Scene scene = scene::read_scene(INTERFLECT_SOURCE_DIR "/data/scenes/two_rooms.json");
  const auto rays = raycast::make_ray_caster("embree", scene);
  core::LocalRun run(1, 2);
  Goal::AtPoints dark;
  for (const measure::SensorPoint& point : measure::sensor_points(scene))
    if (point.sensor == "dark_plane") dark.points.push_back(point.at);
  RadiositySettings settings;
  settings.order = 2;
  settings.form_factors = "analytic";
  const auto passes = [&](double target) {
    return adapt_elements(scene, settings, {{"dark_plane", dark}, target}, *rays, run.get()).adaptation.passes;
  };
  settings.element_size = 3;
  const AdaptivePass quadratic = passes(0).back();
  settings.element_size = 0;
  const std::vector<AdaptivePass> made = passes(.8 * quadratic.relative);
  const double few = elements_with(quadratic.relative, made);
  std::printf("order 2: %td elements err %.2g, made for the goal: %.0f\n", quadratic.elements, quadratic.relative, few);
  EXPECT_LE(5 * few, double(quadratic.elements));
  EXPECT_NEAR(made.back().value[0], quadratic.value[0], made.back().error[0] + quadratic.error[0]);

  settings.order = 1;
  settings.element_size = 1.5;
  const AdaptivePass linear = passes(0).back();
  const double fewer = elements_with(linear.relative, made);
  std::printf("order 1: %td elements err %.2g, made for the goal: %.0f\n", linear.elements, linear.relative, fewer);
  EXPECT_LE(5 * fewer, double(linear.elements));
}

}  // namespace
}  // namespace interflect::fem
