// Two unit squares that face each other at distance 1; the lower one glows.  How much light reaches the upper one, by
// finite elements and by path tracing?
//
// The integral equation's solution, by a Nystroem method on graded meshes, is a mean radiosity of 0.100947189 on the
// upper plate, so that its mean irradiance, B / rho, is 0.201894378.

#include <cstdio>

#include "core/run.h"
#include "fem/radiosity_method.h"
#include "measure/surface_measurements.h"
#include "montecarlo/path_tracer.h"
#include "scene/builder.h"

int main() {
  using namespace interflect;

  scene::SceneBuilder builder({"power"}, scene::Quantity::radiometric);
  const auto glowing = builder.add_material({"glowing", Spectrum(0.5), Spectrum(1.0), scene::Sides::front});
  const auto grey = builder.add_material({"grey", Spectrum(0.5), Spectrum(0.0), scene::Sides::front});
  builder.add_polygon("lower", {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}}, glowing);
  const auto upper = builder.add_polygon("upper", {{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, {}}, grey);
  const scene::Scene scene = builder.finish();

  core::LocalRun local;
  Run& run = local.get();
  const std::vector<measure::Measurement> asked{measure::Flux{measure::patches_of(scene, upper, scene::Side::front)}};

  fem::RadiositySettings settings;
  settings.element_size = 0.1;
  const fem::RadiositySolution solution = fem::solve_radiosity(scene, settings, run);
  const auto rays = raycast::make_ray_caster(settings.intersector, scene);
  const Estimate fem = fem::RadiosityMethod(solution, *rays).answer(scene, asked, run)[0];
  const Estimate traced = montecarlo::PathTracer({.target = 0.001}).answer(scene, asked, run)[0];

  std::printf("finite elements: %.6f W, error at most about %.6f\n", fem.value[0], fem.error_bound[0]);
  std::printf("path tracing:    %.6f W, standard error %.6f\n", traced.value[0], traced.standard_error[0]);
}
