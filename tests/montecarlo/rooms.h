#pragma once

#include "scene/builder.h"
#include "tests/montecarlo/statistics.h"
#include "tests/support/shapes.h"

/// Rooms in which one method is held against another.
namespace interflect::test {

/// Of two channels.
inline Spectrum both(double a, double b) {
  Spectrum s = grey(a);
  s[1] = b;
  return s;
}
inline scene::Material diffuse(const std::string& name, const Spectrum& reflectance, const Spectrum& exitance) {
  scene::Material material;
  material.name = name, material.reflectance = reflectance, material.exitance = exitance;
  return material;
}
/// Of both sides.
inline scene::Material finished(scene::Finish finish, const Spectrum& reflectance = Spectrum::zero()) {
  scene::Material material;
  material.name = "m", material.finish = std::move(finish), material.reflectance = reflectance;
  material.sides = scene::Sides::both;
  return material;
}

inline geometry::PlanarPolygon parallelogram(const Vec3& corner, const Vec3& u, const Vec3& v) {
  return {{corner, corner + u, corner + u + v, corner + v}, {}};
}

/// A room that is not convex, of three reflectances, with a block that hides and a lamp.
inline scene::Scene furnished(double scale) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  scene::SceneBuilder builder({"a", "b"});
  const auto of = [&](double a, double b, double lamp = 0) {
    return builder.add_material(diffuse("m", both(a, b), both(lamp, 2 * lamp)));
  };
  const auto grey = of(.5, .3), bright = of(.8, .7), dark = of(.1, .2), lamp = of(.2, .6, 5);
  const auto add = [&](const char* name, const Vec3& corner, const Vec3& u, const Vec3& v, scene::MaterialId material) {
    builder.add_polygon(name, parallelogram(scale * corner, scale * u, scale * v), material);
  };
  add("floor", Vec3::Zero(), 3 * x, 2 * y, grey);
  add("ceiling", z, 2 * y, 3 * x, bright);
  add("south", Vec3::Zero(), z, 3 * x, dark);
  add("north", 2 * y, 3 * x, z, grey);
  add("west", Vec3::Zero(), 2 * y, z, bright);
  add("east", 3 * x, z, 2 * y, dark);
  builder.add_box("block", geometry::Box(scale * Vec3(1, .6, .1), scale * Vec3(1.6, 1.1, .5)), grey);
  add("lamp", Vec3(2, .5, .95), .4 * y, .5 * x, lamp);
  builder.scene().cameras.push_back({"c", scale * Vec3(.1, .1, .6), scale * Vec3(2, 1.5, .3), z, 70, 6, 4});
  return builder.finish();
}

/// All that can be asked of it: patches, fluxes, points in the air and on walls, and pixels.
inline std::vector<measure::Measurement> all_of_furnished(const scene::Scene& scene, double scale) {
  std::vector<measure::Measurement> asked;
  for (const scene::SurfaceId id : scene.surface_ids()) {
    const auto patches = measure::patches_of(scene, id, scene::Side::front);
    asked.push_back(measure::PatchIrradiance{patches[0]});
    asked.push_back(measure::Flux{patches});
  }
  asked.push_back(all_fronts(scene));
  asked.push_back(measure::PointIrradiance{scale * Vec3(.5, 1, .4), Vec3(.6, 0, .8), {}});
  asked.push_back(measure::PointIrradiance{scale * Vec3(2, 1, 0), Vec3::UnitZ(), surface_named(scene, "floor")});
  for (int k = 0; k < 4; ++k) asked.push_back(measure::PixelRadiance{{0}, k + 1, k});
  return asked;
}

/// Two unit squares that face each other, the lower one bright, both of reflectance 1/2; a camera between them that sees
/// the whole upper one.
inline scene::Scene facing_squares() {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  scene::SceneBuilder builder({"grey"});
  builder.add_polygon("upper", parallelogram(z, y, x), builder.add_material(diffuse("upper", .5, 0)));
  builder.add_polygon("lower", parallelogram(Vec3::Zero(), x, y), builder.add_material(diffuse("lower", .5, 1)));
  builder.scene().cameras.push_back(
      {"c", Vec3(.5, .5, .5), Vec3(.5, .5, 1), x, scene::Projection(scene::Orthographic{1}), 1, 1});
  return builder.finish();
}

/// A room with half a ceiling and lights of every kind: surfaces aside, a point, a spot, a ball, the sun and a sky.
inline scene::Scene lit_by_all() {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  scene::SceneBuilder builder({"a", "b"});
  const auto wall = builder.add_material(diffuse("m", both(.5, .3), both(0, 0)));
  const auto add = [&](const char* name, const Vec3& corner, const Vec3& u, const Vec3& v) {
    builder.add_polygon(name, parallelogram(corner, u, v), wall);
  };
  add("floor", Vec3::Zero(), 3 * x, 2 * y);
  add("south", Vec3::Zero(), z, 3 * x);
  add("north", 2 * y, 3 * x, z);
  add("west", Vec3::Zero(), 2 * y, z);
  add("east", 3 * x, z, 2 * y);
  add("half a ceiling", z, 2 * y, 1.5 * x);
  scene::Lights& lights = builder.scene().lights;
  lights.points.push_back({"p", Vec3(.4, .5, .7), both(.3, .2)});
  lights.spots.push_back({"s", Vec3(2.5, 1.5, .9), Vec3(-.6, 0, -.8), both(1, 2), .95, .8});
  lights.spheres.push_back({"b", Vec3(1.2, 1.3, .4), .15, both(4, 1)});
  lights.suns.push_back({"sun", Vec3(-.48, .36, -.8), both(3, 2)});
  lights.sky = scene::Sky{z, both(.4, .8), both(0, 0)};
  return builder.finish();
}

/// Every front of it, all of them together, and two points.
inline std::vector<measure::Measurement> all_of_lit(const scene::Scene& scene) {
  std::vector<measure::Measurement> asked{all_fronts(scene)};
  for (const scene::SurfaceId id : scene.surface_ids())
    asked.push_back(measure::Flux{measure::patches_of(scene, id, scene::Side::front)});
  asked.push_back(measure::PointIrradiance{Vec3(2, 1, .2), Vec3::UnitZ(), {}});
  asked.push_back(measure::PointIrradiance{Vec3(.5, 1, .3), Vec3(.6, 0, .8), {}});
  return asked;
}

/// A room of three by two by one metre, its walls alone.
inline void add_walls(scene::SceneBuilder& builder) {
  builder.add_box("room", {Vec3(0, 0, 0), Vec3(3, 2, 1)},
                  builder.add_material(diffuse("wall", both(.5, .3), both(0, 0))), scene::SceneBuilder::Facing::inward);
}
/// On one of them.
inline void add_mirror(scene::SceneBuilder& builder) {
  builder.add_polygon("mirror", parallelogram(Vec3(.2, 1.98, .1), 1.2 * Vec3::UnitX(), .7 * Vec3::UnitZ()),
                      builder.add_material(finished(scene::Mirror{both(.9, .7)})));
}

/// A room with every material: a mirror on a wall, a block of glass, a rough one, metal, plastic, a net, and small lamps.
/// Five cameras look into it.
inline scene::Scene shiny() {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  scene::SceneBuilder builder({"a", "b"});
  const auto of = [&](scene::Finish finish, const Spectrum& reflectance = Spectrum::zero()) {
    return builder.add_material(finished(std::move(finish), reflectance));
  };
  add_walls(builder);
  const auto lamps = builder.add_material(diffuse("lamp", both(.1, .3), both(40, 20)));
  builder.add_polygon("lamp", parallelogram(Vec3(1.2, .6, .95), .2 * y, .3 * x), lamps);
  builder.add_polygon("other lamp", parallelogram(Vec3(2.6, 1.5, .9), .1 * y, .2 * x), lamps);
  add_mirror(builder);
  builder.add_box("glass", {Vec3(2, .7, .2), Vec3(2.5, 1.2, .6)}, of(scene::Glass{1.5, 0}));
  builder.add_box("rough glass", {Vec3(.4, .2, .05), Vec3(.7, .5, .4)}, of(scene::Glass{1.5, .4}));
  builder.add_box("metal", {Vec3(1.1, .2, .05), Vec3(1.4, .5, .5)}, of(scene::Metal{both(.9, .6), .3}));
  builder.add_box("plastic", {Vec3(1.1, 1.2, .05), Vec3(1.5, 1.5, .4)}, of(scene::Plastic{1.5}, both(.6, .4)));
  builder.add_polygon("pane", parallelogram(Vec3(1.8, .2, .05), 1.5 * y, .8 * z), of(scene::Pane{both(.8, .6)}));
  scene::Material net = diffuse("net", .3, 0, scene::Sides::both);
  net.reflectance[1] = .6, net.opacity = .4;
  builder.add_polygon("net", parallelogram(Vec3(.8, .1, .02), 1.7 * y, .9 * z), builder.add_material(net));
  for (const scene::Projection& projection :
       {scene::Projection(scene::Pinhole{80}), scene::Projection(scene::ThinLens{80, .05, 1}),
        scene::Projection(scene::Orthographic{.5}), scene::Projection(scene::Panoramic{}),
        scene::Projection(scene::Fisheye{})})
    builder.scene().cameras.push_back({"c" + std::to_string(builder.scene().cameras.size()), Vec3(.2, .9, .5),
                                       Vec3(2.2, 1, .35), z, projection, 3, 3});
  return builder.finish();
}

/// The same numbers by two methods, within their own errors; a standard error of the first above `largest_error` of the
/// value would prove nothing, and fails.
inline void expect_same(const measure::Method& method, const measure::Method& other, const scene::Scene& scene,
                        const std::vector<measure::Measurement>& asked, double largest_error, std::uint64_t seed = 3) {
  core::LocalRun run(seed);
  const auto known = other.answer(scene, asked, run.get()), found = method.answer(scene, asked, run.get());
  const double limit = critical_z(alpha, asked.size() * static_cast<std::size_t>(scene.channel_count()));
  for (std::size_t m = 0; m < asked.size(); ++m)
    for (int c = 0; c < scene.channel_count(); ++c) {
      const double error = std::hypot(known[m].standard_error[c], found[m].standard_error[c]);
      EXPECT_NEAR(found[m].value[c], known[m].value[c], limit * error) << m << ", channel " << c;
      EXPECT_LT(found[m].standard_error[c], largest_error * known[m].value[c]) << m << ", channel " << c;
    }
}

/// A floor below half a sky, seen from above: rho / pi times pi / 2 times its radiance, 1/2 in each of 16 x 16 pixels.
inline scene::Scene floor_below_a_sky() {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  scene::SceneBuilder builder({"grey"});
  builder.add_polygon("floor", parallelogram(-x - y, 2 * x, 2 * y), builder.add_material(diffuse("f", .5, 0)));
  builder.scene().lights.sky = scene::Sky{x, grey(2), Spectrum::zero()};
  builder.scene().cameras.push_back({"c", z, Vec3::Zero(), y, scene::Projection(scene::Orthographic{1}), 16, 16});
  return builder.finish();
}

}  // namespace interflect::test
