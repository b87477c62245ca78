#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/run.h"
#include "measure/surface_measurements.h"
#include "montecarlo/path_tracer.h"
#include "scene/scene.h"
#include "tests/support/family.h"

/// Path-traced estimates against exact numbers.
namespace interflect::test {

/// What is asked with what is true, up to `slack` (a bound derived where the truth is not exact).
struct Question {
  measure::Measurement asked;
  Spectrum truth;
  std::string name;
  double slack = 0;
};

inline Spectrum grey(double value) {
  Spectrum s;
  s[0] = value;
  return s;
}

/// Every channel of every answer within the critical number of its own standard errors.  A standard error above
/// `largest_error` (relative to the truth) would prove nothing, and fails.
inline void expect_agreement(const measure::Method& method, const scene::Scene& scene,
                             const std::vector<Question>& questions, double largest_error, std::uint64_t seed = 1) {
  ASSERT_GT(scene.channel_count(), 0);
  std::vector<measure::Measurement> asked;
  for (const Question& question : questions) asked.push_back(question.asked);
  core::LocalRun run(seed);
  const std::vector<Estimate> found = method.answer(scene, asked, run);
  const double limit = critical_z(alpha, questions.size() * static_cast<std::size_t>(scene.channel_count()));
  for (std::size_t i = 0; i < found.size(); ++i)
    for (int c = 0; c < scene.channel_count(); ++c) {
      const double truth = questions[i].truth[c], error = std::abs(found[i].value[c] - truth),
                   se = found[i].standard_error[c];
      EXPECT_LE(error, questions[i].slack + limit * se + 1e-12 * truth)
          << questions[i].name << " channel " << c << ": " << found[i].value[c] << " +- " << se << ", truth " << truth;
      EXPECT_TRUE(truth == 0 || se < largest_error * truth) << questions[i].name << " channel " << c << ": " << se;
      EXPECT_EQ(found[i].claim, Claim::guaranteed);
      EXPECT_EQ(found[i].error_bound[c], 0);
    }
}

inline void expect_agreement(const scene::Scene& scene, const std::vector<Question>& questions,
                             const montecarlo::PathTracerSettings& settings, double largest_error,
                             std::uint64_t seed = 1) {
  expect_agreement(montecarlo::PathTracer(settings), scene, questions, largest_error, seed);
}

inline scene::SurfaceId surface_named(const scene::Scene& scene, const std::string& name) {
  for (const scene::SurfaceId id : scene.surface_ids())
    if (scene.surface(id).name == name) return id;
  throw core::PreconditionError("no surface " + name);
}

/// All of a side of a surface, with its mean irradiance as the truth.
inline Question whole(const scene::Scene& scene, const std::string& name, const Spectrum& mean_irradiance,
                      scene::Side side = scene::Side::front) {
  const scene::SurfaceId id = surface_named(scene, name);
  return {measure::Flux{measure::patches_of(scene, id, side)}, scene.area(id) * mean_irradiance, name};
}
inline Question whole(const scene::Scene& scene, const std::string& name, double mean_irradiance,
                      scene::Side side = scene::Side::front) {
  return whole(scene, name, grey(mean_irradiance), side);
}

inline Question at_point(const Vec3& position, const Vec3& normal, double irradiance,
                         std::optional<scene::SurfaceId> on = {}) {
  return {measure::PointIrradiance{position, normal, on}, grey(irradiance), "point"};
}

/// Everything that arrives on the fronts of all surfaces.
inline measure::Flux all_fronts(const scene::Scene& scene) {
  measure::Flux flux;
  for (const scene::SurfaceId id : scene.surface_ids())
    for (const auto& patch : measure::patches_of(scene, id, scene::Side::front)) flux.through.push_back(patch);
  return flux;
}

}  // namespace interflect::test
