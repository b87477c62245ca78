#include "apps/first_pass.h"

#include <algorithm>
#include <ctime>
#include <iterator>

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
bool inherits_error(const std::string& integrator) { return montecarlo::integrator_entry(integrator).inherits_error; }

}  // namespace

FirstPass::FirstPass(const scene::Scene& scene, const std::vector<std::string>& integrators,
                     const measure::PathClasses& paths, const std::string& intersector, Run& run) {
  std::vector<std::string> need;
  std::ranges::copy_if(integrators, std::back_inserter(need), needs_solution);
  if (need.empty()) return;
  // What inherits its error asks more of a solution than what is only guided by it, and says so itself beside that.
  const auto guided = std::ranges::find_if_not(need, inherits_error);
  const std::clock_t begin = std::clock();
  try {
    if (guided == need.end()) montecarlo::require_known_to_two_passes(scene, paths);
    fem::RadiositySolution radiosity = fem::solve_radiosity(scene, settings_by(intersector), run);
    const auto rays = raycast::make_ray_caster(intersector, scene);
    fem::MirroredLight mirrored = fem::mirrored_light(scene, radiosity, *rays, run);
    solved_ = std::make_unique<Solved>(Solved{std::move(radiosity), std::move(mirrored)});
  } catch (const core::InputError& error) {
    refused_ = error.what();
    if (guided != need.end())
      refused_ = *guided + " starts from a radiosity solution, as path does not, and there is none: " + refused_;
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
