#pragma once

#include <array>

#include "montecarlo/integrators.h"
#include "tests/montecarlo/statistics.h"
#include "tests/support/direct_light.h"
#include "tests/support/shapes.h"

/// Scenes with what is true of them.  Truths: docs/truths.md 2.0, 2.1, 2.6, 2.9, or derived beside the scene.
namespace interflect::test {

struct KnownScene {
  std::string name;
  scene::Scene scene;
  std::vector<Question> questions;
};

/// A random room that is not convex; every wall has the material.
inline scene::Scene random_room(const scene::Material& material, std::vector<std::string> channels,
                                const Placing& placing) {
  core::RandomNumbers numbers(8, 0, 0);
  const geometry::Ring floor = random_star(9, numbers);
  const Eigen::Matrix3d turn = random_rotation(numbers);
  scene::SceneBuilder builder(std::move(channels));
  add_prism_room(builder, floor, 0.7, builder.add_material(material), [&](const Vec3& x) { return placing(turn * x); });
  builder.scene().cameras.push_back(
      {"inside", placing(turn * Vec3(0, 0, 0.35)), placing(turn * Vec3(1, 0.2, 0.5)), turn * Vec3::UnitZ(), 60, 8, 6});
  return builder.finish();
}

/// Furnace: E = 1 - rho on all walls gives B = 1 = H; channel by channel another rho.
template <std::size_t channels>
scene::Material furnace_wall(const std::array<double, channels>& rho) {
  scene::Material material;
  for (std::size_t c = 0; c < channels; ++c) {
    const int channel = static_cast<int>(c);
    material.reflectance[channel] = rho[c], material.exitance[channel] = 1 - rho[c];
  }
  return material;
}

/// 2.1: sphere, E = 1 + cos(theta), rho = 1/2: B = E + rho m with m = <E> / (1 - rho) = 2, so H = 2 everywhere.  Here it
/// is an icosphere of 1280 surfaces, in which some things are exact:
///   all of it: <E> / (1 - rho), as of any closed polyhedron;
///   two facets that mirror each other in z = 0: E is a constant, which gives H = 2 in any closed polyhedron, and what
///   changes its sign from the one to the other, whose light on both together is 0.
inline KnownScene sphere_of_varying_emission() {
  scene::SceneBuilder builder({"grey"});
  double flux = 0;
  for (const auto& corners : icosphere(3, 2, true)) {
    const Vec3 centre = (corners[0] + corners[1] + corners[2]).normalized();
    const std::array<TriangleCorners, 1> one{corners};
    builder.add_facets("facet", one, builder.add_material(diffuse("m", 0.5, 1 + centre.z())));
    flux += builder.scene().facets.back().area * (1 + centre.z());
  }
  KnownScene known{"sphere", builder.finish(), {}};
  known.questions.push_back({all_fronts(known.scene), grey(2 * flux), "all"});
  return known;
}

/// A facet of that sphere and its image in z = 0.
inline Question mirrored_pair(const scene::Scene& sphere, scene::SurfaceId id) {
  const auto patch_of = [&](scene::SurfaceId of) { return measure::patches_of(sphere, of, scene::Side::front)[0]; };
  const scene::SurfacePatch patch = patch_of(id);
  const Vec3 image = patch.centroid().cwiseProduct(Vec3(1, 1, -1));
  for (const scene::SurfaceId other : sphere.surface_ids())
    if ((patch_of(other).centroid() - image).norm() < 1e-9) {
      return {measure::Flux{{patch, patch_of(other)}}, grey(2 * (sphere.area(id) + sphere.area(other))),
              sphere.surface(id).name + " and its image"};
    }
  throw core::PreconditionError("no image of " + sphere.surface(id).name);
}

/// Unit cube, floor emits 1, one reflectance, 0.5 or 0.8 (2.6, continuous limit): H = (B - E) / rho.
inline KnownScene cube_with_one_emitting_face(double rho) {
  struct Truth {
    double rho, floor, ceiling, wall, digits;
  };
  static constexpr std::array<Truth, 2> truths{
      {{0.5, 1.1043615, 0.1712161, 0.1811056, 5e-7}, {0.8, 1.587505, 0.660979, 0.687879, 2e-6}}};
  const Truth& truth = truths[rho == truths[0].rho ? 0 : 1];
  if (rho != truth.rho) throw core::PreconditionError("no truth of this reflectance");
  scene::SceneBuilder builder({"grey"});
  const auto wall = builder.add_material(diffuse("wall", rho, 0)), lit = builder.add_material(diffuse("lit", rho, 1));
  builder.add_box("cube", {Vec3(0, 0, 0), Vec3(1, 1, 1)}, wall, scene::SceneBuilder::Facing::inward);
  builder.scene().surfaces[surface_named(builder.scene(), "cube/z-").value].material = lit;
  KnownScene known{rho == 0.5 ? "grey_cube" : "bright_cube", builder.finish(), {}};
  known.questions = {whole(known.scene, "cube/z-", (truth.floor - 1) / rho),
                     whole(known.scene, "cube/z+", truth.ceiling / rho),
                     whole(known.scene, "cube/x-", truth.wall / rho), whole(known.scene, "cube/y+", truth.wall / rho)};
  for (Question& question : known.questions) question.slack = truth.digits / rho;
  return known;
}

/// A square about the z axis.
inline geometry::PlanarPolygon level_square(double half_side, double z, bool up) {
  const double s = half_side;
  geometry::Ring ring{Vec3(-s, -s, z), Vec3(s, -s, z), Vec3(s, s, z), Vec3(-s, s, z)};
  if (!up) std::reverse(ring.begin(), ring.end());
  return {ring, {}};
}

/// 2.9: square source (half side 1/2) at height 2, square blocker (half side 1/2) at height 1; the floor, and points on
/// it in the umbra, in the penumbra and outside of both.
inline KnownScene penumbra_of_a_square() {
  scene::SceneBuilder builder({"grey"});
  const auto black = builder.add_material(diffuse("m", 0, 0));
  builder.add_polygon("source", level_square(0.5, 2, false), builder.add_material(diffuse("m", 0, 1)));
  builder.add_polygon("blocker", level_square(0.5, 1, true), black);
  const auto floor = builder.add_polygon("floor", level_square(2, 0, true), black);
  KnownScene known{"penumbra", builder.finish(), {}};
  known.questions = {whole(known.scene, "floor", 0.021573468864)};
  for (const DirectLight& row : direct_light)
    known.questions.push_back(at_point(row.x, Vec3::UnitZ(), row.blocked, floor));
  return known;
}

/// What is known, by other integrators than path tracing: of light tracing `samples` serve all questions.
inline void expect_found_by(const std::string& integrator, std::uint64_t samples, const KnownScene& known,
                            double largest_error) {
  SCOPED_TRACE(integrator);
  montecarlo::IntegratorSettings settings;
  settings.samples = samples;
  expect_agreement(*montecarlo::make_integrator(integrator, settings), known.scene, known.questions, largest_error);
}

}  // namespace interflect::test
