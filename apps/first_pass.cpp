#include "apps/first_pass.h"

#include <algorithm>
#include <ctime>

#include "core/error.h"
#include "fem/surface_solution.h"
#include "montecarlo/integrators.h"
#include "montecarlo/two_pass/two_pass.h"
#include "raycast/ray_caster.h"

namespace interflect::apps {
namespace {

fem::RadiositySettings settings_by(const std::string& intersector) {
  fem::RadiositySettings settings;
  settings.intersector = intersector;
  settings.rough_is_black = true;
  return settings;
}

bool needs_solution(const std::string& integrator) { return montecarlo::integrator_entry(integrator).needs_solution; }

}  // namespace

FirstPass::FirstPass(const scene::Scene& scene, const std::vector<std::string>& integrators,
                     const measure::PathClasses& paths, const std::string& intersector, Run& run) {
  if (std::none_of(integrators.begin(), integrators.end(), needs_solution)) return;
  const std::clock_t begin = std::clock();
  try {
    montecarlo::require_known_to_two_passes(scene, paths);
    fem::RadiositySolution radiosity = fem::solve_radiosity(scene, settings_by(intersector), run);
    const auto rays = raycast::make_ray_caster(intersector, scene);
    fem::MirroredLight mirrored = fem::mirrored_light(scene, radiosity, *rays, run);
    solved_ = std::make_unique<Solved>(Solved{std::move(radiosity), std::move(mirrored)});
  } catch (const core::InputError& error) {
    refused_ = error.what();
  }
  processor_seconds_ = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

void FirstPass::require_solved() const {
  if (!refused_.empty()) throw core::InputError(refused_);
}

measure::SurfaceSolution FirstPass::solution() const {
  measure::SurfaceSolution solution;
  if (solved_) solution = fem::as_surface_solution(solved_->radiosity, solved_->mirrored);
  solution.why_none = refused_;
  solution.processor_seconds = processor_seconds_;
  return solution;
}

}  // namespace interflect::apps
