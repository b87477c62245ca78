#pragma once

#include <gtest/gtest.h>

#include "core/run.h"
#include "fem/radiosity_method.h"
#include "measure/surface_measurements.h"
#include "montecarlo/path_tracer.h"
#include "validation/statistics.h"

/// Both methods asked the same of a scene file, each held against the truth with the error that it claims itself.
namespace interflect::test {

/// The mean irradiance of all surfaces whose names begin so, per channel.
struct Truth {
  std::string surfaces;
  std::vector<double> irradiance;
  double slack = 0;  ///< how far the scene's own truth may be from it, absolute (a polyhedron that stands for a sphere)
};

struct Effort {
  double element_size = 0.25;
  double tolerance = 1e-5;  ///< of an unoccluded form factor
  int visibility_rays = 64;
  std::uint64_t samples = 40'000;
  double fem_error = 0.05;  ///< relative: neither method's own error may be larger, or agreement would prove little
  double mc_error = 0.02;
  std::string intersector = "embree";
};

/// Everything that arrives on the fronts of those surfaces; `area` [m²] is theirs.
inline measure::Flux arriving_on(const scene::Scene& scene, const std::string& surfaces, double& area) {
  measure::Flux flux;
  area = 0;
  for (const scene::SurfaceId id : scene.surface_ids()) {
    if (!scene.surface(id).name.starts_with(surfaces)) continue;
    const auto patches = measure::patches_of(scene, id, scene::Side::front);
    flux.through.insert(flux.through.end(), patches.begin(), patches.end());
    area += scene.area(id);
  }
  EXPECT_GT(area, 0) << "no surface is named " << surfaces;
  return flux;
}

/// A scene solved, with what answers from the solution.
struct Solved {
  Solved(const scene::Scene& scene, const Effort& effort, bool restore_closure = false)
      : rays(raycast::make_ray_caster(effort.intersector, scene)), solution(solve(scene, effort, restore_closure)) {}

  static fem::RadiositySolution solve(const scene::Scene& scene, const Effort& effort, bool restore_closure) {
    fem::RadiositySettings settings;
    settings.element_size = effort.element_size;
    settings.quadrature_tolerance = effort.tolerance;
    settings.visibility_rays = effort.visibility_rays;
    settings.intersector = effort.intersector;
    if (restore_closure) settings.closure = "scaling";
    settings.stopping.tolerance = 1e-13;
    core::LocalRun run;
    return fem::solve_radiosity(scene, settings, run.get());
  }
  std::vector<Estimate> answer(const scene::Scene& scene, std::span<const measure::Measurement> asked) const {
    core::LocalRun run;
    return fem::RadiosityMethod(solution, *rays).answer(scene, asked, run.get());
  }

  std::unique_ptr<raycast::RayCaster> rays;
  fem::RadiositySolution solution;
};

/// Mean irradiance over the surfaces of each truth, as a method's answers say.
inline std::vector<Estimate> means(
    const scene::Scene& scene, const std::vector<Truth>& truths,
    const std::function<std::vector<Estimate>(std::span<const measure::Measurement>)>& answer) {
  std::vector<measure::Measurement> asked;
  std::vector<double> areas;
  for (const Truth& truth : truths) asked.emplace_back(arriving_on(scene, truth.surfaces, areas.emplace_back()));
  std::vector<Estimate> found = answer(asked);
  for (std::size_t k = 0; k < found.size(); ++k) found[k] = scaled(found[k], 1 / areas[k]);
  return found;
}

/// |answer - truth| <= slack + bound + z_max SE, family alpha 1e-3 by Sidak, and bound + SE <= `largest_error`
/// relative.
inline void expect_true(const std::string& method, const scene::Scene& scene, const std::vector<Truth>& truths,
                        const std::vector<Estimate>& found, double largest_error) {
  const double z_max = validation::sidak_z_max(1e-3, truths.size() * static_cast<std::size_t>(scene.channel_count()));
  for (std::size_t k = 0; k < truths.size(); ++k)
    for (int c = 0; c < scene.channel_count(); ++c) {
      const double truth = truths[k].irradiance[static_cast<std::size_t>(c)], H = found[k].value[c],
                   bound = found[k].error_bound[c], noise = found[k].standard_error[c];
      EXPECT_LE(std::abs(H - truth), truths[k].slack + bound + z_max * noise + 1e-12)
          << method << ": " << truths[k].surfaces << " channel " << c << ": " << H << " +- " << noise << ", bound "
          << bound << ", truth " << truth;
      EXPECT_TRUE(truth == 0 || bound + noise <= largest_error * truth)
          << method << ": " << truths[k].surfaces << " channel " << c << ": error " << bound + noise << " of " << truth;
    }
}

inline std::vector<Estimate> traced_means(const scene::Scene& scene, const std::vector<Truth>& truths,
                                          const Effort& effort) {
  return means(scene, truths, [&](std::span<const measure::Measurement> asked) {
    core::LocalRun run;
    const montecarlo::PathTracer tracer({.samples = effort.samples, .intersector = effort.intersector});
    return tracer.answer(scene, asked, run.get());
  });
}

inline void expect_both_true(const scene::Scene& scene, const std::vector<Truth>& truths, const Effort& effort) {
  const Solved solved(scene, effort);
  expect_true("radiosity", scene, truths, means(scene, truths, [&](auto asked) { return solved.answer(scene, asked); }),
              effort.fem_error);
  expect_true("path tracing", scene, truths, traced_means(scene, truths, effort), effort.mc_error);
}

}  // namespace interflect::test
