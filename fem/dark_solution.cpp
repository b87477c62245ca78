#include "fem/dark_solution.h"

#include <algorithm>

#include "fem/element_materials.h"
#include "fem/energy.h"
#include "fem/space/polynomials.h"
#include "fem/specular/light_caster.h"
#include "fem/specular/specular_chains.h"
#include "fem/stage_clock.h"

namespace interflect::fem {
namespace {

/// The one pass that elements had.
Adaptation adaptation_of(const RadiositySettings& settings, Index elements) {
  AdaptivePass pass{};
  pass.elements = elements;
  pass.unknowns = elements * plane_functions(settings.order);
  return {settings.adaptive->goal, {pass}, AdaptiveStop::no_light};
}

PolynomialField zero_field(const RadiositySolution& s, int order, int channels) {
  const Index elements = s.mesh.size(), functions = plane_functions(order);
  const solvers::ColumnMatrix zero = solvers::ColumnMatrix::Zero(elements * functions, channels);
  return {order, functions, std::vector<int>(s.radiosity.size(), order), bases_of(order, s.mesh.patches()), zero,
          zero,  zero};
}

RadiositySolution zero_on(mesh::ElementMesh mesh, const scene::Scene& scene, const RadiositySettings& settings) {
  RadiositySolution s(std::move(mesh), element_size_of(scene, settings));
  s.reflectance = materials_of(scene, s.mesh.patches()).reflectance;
  for (auto* of_elements : {&s.exitance, &s.radiosity, &s.irradiance, &s.irradiance_error, &s.irradiance_noise,
                            &s.field_error, &s.coarse_radiosity})
    of_elements->assign(s.mesh.patches().size(), Spectrum::zero());
  s.solver.why = solvers::SolverReport::Stopped::nothing_to_do;
  if (settings.order > 0) s.field = zero_field(s, order_of_blocks(settings, s.mesh.patches()), scene.channel_count());
  if (settings.adaptive) s.adaptation = adaptation_of(settings, s.mesh.size());
  return s;
}

}  // namespace

bool is_dark(const scene::Scene& scene) {
  const auto ids = scene.surface_ids();
  return std::all_of(ids.begin(), ids.end(), [&](scene::SurfaceId id) {
    const scene::Material& material = scene.material(id);
    return !material.is_diffuse() || material.exitance.is_zero();
  });
}

RadiositySolution dark_solution(const scene::Scene& scene, const RadiositySettings& settings, Run& run) {
  std::vector<StageCost> stages;
  StageClock timed(stages);
  mesh::ElementMesh mesh = timed("mesh", [&] { return elements_alone(scene, settings); });
  const auto rays = timed("ray tree", [&] { return make_light_caster(settings.intersector, scene, run.seed); });
  require_outside_glass(scene, mesh.patches(), *raycast::make_ray_caster(settings.intersector, scene), run);
  RadiositySolution s = zero_on(std::move(mesh), scene, settings);
  timed("energy balance", [&] {
    const LostRays lost = cast_lost_rays(scene, s.mesh.patches(), s.radiosity, *rays, run);
    s.closed = lost.lost == 0;
    s.energy = energy_balance(s, lost);
  });
  s.stages = std::move(stages);
  return s;
}

Forecast forecast_of_darkness(const scene::Scene& scene, const RadiositySettings& settings) {
  const auto elements = static_cast<double>(elements_alone(scene, settings).size());
  return {elements, elements * bytes_of_an_element, 0};
}

}  // namespace interflect::fem
