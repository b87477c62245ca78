#include "fem/specular/specular_settings.h"

#include "core/error.h"
#include "fem/element_materials.h"
#include "fem/specular/specular_chains.h"

namespace interflect::fem {
namespace {

/// What form factors are made by, or what a solver goes by in their place.
void require_rays(const std::string& surface, const RadiositySettings& settings) {
  using Needs = solvers::SolverEntry::Needs;
  const solvers::SolverEntry& solver = solvers::solver_named(settings.solver);
  if (solver.needs == Needs::lines || solver.needs == Needs::closed_room)
    throw core::InputError("solver '" + settings.solver + "'", "its lines go straight, and '" + surface +
                                                                   "' is a mirror or glass: another solver expected");
  if (!solver.samples() && settings.form_factors != "hemisphere-rays")
    throw core::InputError("form factors by '" + settings.form_factors + "'",
                           "they see what is straight ahead, and '" + surface +
                               "' is a mirror or glass: hemisphere-rays, which go on there, expected");
}

}  // namespace

RadiositySettings with_mirrors_seen(const scene::Scene& scene, RadiositySettings settings) {
  constexpr std::uint64_t rays_a_row = 8192;
  if (settings.form_factors_chosen || settings.form_factors != default_form_factors || !any_smooth(scene))
    return settings;
  settings.form_factors = "hemisphere-rays";
  if (settings.samples == 0 && settings.row_tolerance == 0) settings.samples = rays_a_row;
  return settings;
}

void require_solvable(const scene::Scene& scene, const RadiositySettings& settings) {
  require_diffuse_or_smooth(scene, settings.rough_is_black);
  const auto smooth = any_smooth(scene);
  if (!smooth) return;
  const std::string& surface = scene.surface(*smooth).name;
  const auto refuse = [&](const std::string& what) {
    throw core::InputError("'" + surface + "', a mirror or glass", "it does not go with " + what);
  };
  if (settings.adaptive) refuse("elements made for a goal: no --goal or --target-error expected");
  if (settings.projection != Projection::galerkin) refuse("values at nodes: --projection galerkin expected");
  if (settings.order > 0) refuse("polynomials: --order 0 expected");
  if (settings.closure != "none") refuse("a closure that is restored, since it absorbs: --closure none expected");
  if (settings.stored_factors) refuse("view factors of a file");
  require_rays(surface, settings);
}

}  // namespace interflect::fem
