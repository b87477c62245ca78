#pragma once

#include "measure/surface_measurements.h"
#include "tests/montecarlo/rooms.h"

/// A sun beside a mirror, H = 1 across its rays: a floor gets .8 from it and .8 x .8 by the mirror.
namespace interflect::test {

inline constexpr double under_sun_and_mirror = .8 + .8 * .8;

/// To be furnished.  What stands in the mirror's place throws as much.
inline scene::SceneBuilder beside_a_sun(const scene::Finish& wall = scene::Mirror{grey(.8)}, double scale = 1,
                                        double angular_radius = scene::Sun::seen_from_earth,
                                        const Vec3& direction = Vec3(.6, 0, -.8)) {
  scene::SceneBuilder builder({"grey"});
  const Vec3 x = scale * Vec3::UnitX(), y = scale * Vec3::UnitY(), z = scale * Vec3::UnitZ();
  scene::Material material;
  material.name = "wall", material.finish = wall;
  builder.add_polygon("floor", parallelogram(Vec3::Zero(), x, y), builder.add_material(diffuse("grey", .5, 0)));
  builder.add_polygon("wall", parallelogram(x, 2 * z, y), builder.add_material(material));
  builder.scene().lights.suns.push_back(
      {.name = "sun", .direction = direction, .irradiance = grey(1), .angular_radius = angular_radius});
  builder.scene().cameras.push_back({"c", .2 * x + .5 * y + 1.2 * z, .5 * x + .5 * y, Vec3::UnitX(), 20, 1, 1});
  return builder;
}

inline scene::Scene sun_and_mirror(double scale, double angular_radius, const Vec3& direction = Vec3(.6, 0, -.8)) {
  return beside_a_sun(scene::Mirror{grey(.8)}, scale, angular_radius, direction).finish();
}

struct UnderSunAndMirror {
  measure::Measurement flux, point, pixel;
};
inline UnderSunAndMirror asked_of_sun_and_mirror(const scene::Scene& scene, double scale) {
  return {measure::Flux{measure::patches_of(scene, surface_named(scene, "floor"), scene::Side::front)},
          measure::PointIrradiance{scale * Vec3(.5, .5, .01), Vec3::UnitZ(), {}}, measure::PixelRadiance{{0}, 0, 0}};
}

}  // namespace interflect::test
