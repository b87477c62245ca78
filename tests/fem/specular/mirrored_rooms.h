#pragma once

#include "scene/builder.h"
#include "tests/fem/rooms.h"

/// Rooms with mirrors and glass, and the same without them where there is such a thing.
namespace interflect::fem::test {

inline scene::Material of_finish(scene::Finish finish, scene::Sides sides = scene::Sides::both) {
  scene::Material material;
  material.name = "smooth", material.finish = std::move(finish), material.sides = sides;
  return material;
}

/// Of two channels.
inline Spectrum both(double a, double b) {
  Spectrum s;
  s[0] = a, s[1] = b;
  return s;
}
inline scene::Material painted(double a, double b, double lamp = 0) {
  scene::Material material = diffuse(0);
  material.name = "painted", material.reflectance = both(a, b), material.exitance = both(lamp, 2 * lamp);
  return material;
}

/// Half of a room that is its own mirror image in the plane x = 0, with a mirror there; or the whole.  Of unequal
/// surfaces, with a block that hides.  Surfaces of the half come first in both.
inline scene::Scene half_or_whole(bool whole, double scale = 1) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  scene::SceneBuilder builder({"a", "b"}, scene::Quantity::radiometric);
  const auto add = [&](const char* name, const Vec3& corner, const Vec3& u, const Vec3& v, scene::MaterialId material) {
    builder.add_polygon(name, parallelogram(scale * corner, scale * u, scale * v), material);
  };
  const auto grey = builder.add_material(painted(.5, .3)), bright = builder.add_material(painted(.8, .7)),
             lamp = builder.add_material(painted(.2, .4, 5));
  for (const double side : {1.0, -1.0}) {
    if (side < 0 && !whole) break;
    const auto mirrored = [&](const char* name, Vec3 corner, Vec3 u, Vec3 v, scene::MaterialId material) {
      if (side < 0) corner.x() = -corner.x(), u.x() = -u.x(), v.x() = -v.x(), std::swap(u, v);
      add(name, corner, u, v, material);
    };
    mirrored("floor", Vec3::Zero(), 2 * x, y, grey);
    mirrored("ceiling", z, y, 2 * x, bright);
    mirrored("south", Vec3::Zero(), z, 2 * x, bright);
    mirrored("north", y, 2 * x, z, grey);
    mirrored("east", 2 * x, z, y, grey);
    mirrored("lamp", Vec3(.3, .3, .9), .2 * y, .3 * x, lamp);
    mirrored("screen", Vec3(.9, .2, 0), .6 * y, .5 * z, builder.add_material(painted(.6, .6)));
  }
  if (!whole)
    builder.add_polygon("mirror", parallelogram(Vec3::Zero(), scale * y, scale * z),
                        builder.add_material(of_finish(scene::Mirror{Spectrum(1)}, scene::Sides::front)));
  return builder.finish();
}

/// A closed room where every wall sends 1: E = 1 - rho.
inline scene::SceneBuilder furnace() {
  scene::SceneBuilder builder({"a", "b"}, scene::Quantity::radiometric);
  scene::Material wall = painted(.5, .8);
  wall.exitance = Spectrum(1) - wall.reflectance;
  builder.add_box("room", {Vec3(0, 0, 0), Vec3(3, 2, 1)}, builder.add_material(wall),
                  scene::SceneBuilder::Facing::inward);
  return builder;
}

inline RadiositySolution solved_by_rays(const scene::Scene& scene, double element_size, std::uint64_t rays,
                                        unsigned threads = 2, std::uint64_t seed = 1,
                                        const std::string& solver = "automatic") {
  RadiositySettings settings;
  settings.element_size = element_size;
  settings.form_factors = "hemisphere-rays";
  settings.samples = rays;
  settings.solver = solver;
  core::LocalRun run(seed, threads);
  return solve_radiosity(scene, settings, run.get());
}

}  // namespace interflect::fem::test
