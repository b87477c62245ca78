#pragma once

#include "measure/surface_solution.h"
#include "montecarlo/integrators.h"
#include "tests/montecarlo/rooms.h"

/// What integrators that need a solution are given where none is solved for.
namespace interflect::test {

/// A solution that says the same of every point.
inline measure::SurfaceSolution says_everywhere(const Spectrum& reflected) {
  measure::SurfaceSolution solution;
  measure::SurfaceSolution::Known known;
  known.reflected = reflected;
  solution.at = [known](const scene::SurfacePoint&) -> const measure::SurfaceSolution::Known& { return known; };
  return solution;
}

/// A room with all materials that two passes know: a mirror, a pane, glass, smooth and rough, and metal.
inline scene::Scene known_to_two_passes() {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  scene::SceneBuilder builder({"a", "b"});
  const auto of = [&](scene::Finish finish) { return builder.add_material(finished(std::move(finish))); };
  add_walls(builder);
  builder.add_polygon("lamp", parallelogram(Vec3(1.2, .6, .95), .4 * y, .6 * x),
                      builder.add_material(diffuse("lamp", both(.1, .3), both(10, 20))));
  add_mirror(builder);
  builder.add_polygon("pane", parallelogram(Vec3(1.9, .1, .05), 1.8 * y, .8 * z), of(scene::Pane{both(.3, .8)}));
  builder.add_box("glass", {Vec3(.8, .4, .1), Vec3(1.2, .8, .4)}, of(scene::Glass{1.5, 0}));
  builder.add_box("frosted", {Vec3(1.3, .2, .1), Vec3(1.6, .6, .4)}, of(scene::Glass{1.5, .4}));
  builder.add_box("metal", {Vec3(.4, 1.2, .1), Vec3(.9, 1.7, .5)}, of(scene::Metal{both(.9, .6), .3}));
  builder.scene().cameras.push_back(
      {"c", Vec3(2.8, 1, .6), Vec3(.3, 1, .4), z, scene::Projection(scene::Pinhole{70}), 6, 4});
  return builder.finish();
}

/// Of the paths that an integrator finds to all that is asked; two passes find all or none.
inline measure::PathClasses paths_found(const std::string& integrator, std::span<const measure::Measurement> asked) {
  measure::PathClasses paths = measure::PathClasses::all();
  if (integrator == "two-pass") return paths;
  const measure::Capabilities finds = montecarlo::make_integrator(integrator, {})->capabilities();
  for (const measure::Measurement& each : asked) paths = paths & finds.paths_to(each);
  return paths;
}

}  // namespace interflect::test
