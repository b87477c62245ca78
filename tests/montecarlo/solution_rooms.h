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
  const auto both = [](double a, double b) {
    Spectrum s = grey(a);
    s[1] = b;
    return s;
  };
  const auto of = [&](scene::Finish finish) {
    scene::Material material;
    material.name = "m", material.finish = std::move(finish), material.sides = scene::Sides::both;
    return builder.add_material(material);
  };
  scene::Material wall = diffuse("wall", .5, 0), lamp = diffuse("lamp", .1, 10);
  wall.reflectance[1] = .3, lamp.reflectance[1] = .3, lamp.exitance[1] = 20;
  builder.add_box("room", {Vec3(0, 0, 0), Vec3(3, 2, 1)}, builder.add_material(wall),
                  scene::SceneBuilder::Facing::inward);
  builder.add_polygon("lamp", parallelogram(Vec3(1.2, .6, .95), .4 * y, .6 * x), builder.add_material(lamp));
  builder.add_polygon("mirror", parallelogram(Vec3(.2, 1.98, .1), 1.2 * x, .7 * z), of(scene::Mirror{both(.9, .7)}));
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
