#pragma once

#include <random>
#include <vector>

#include "fem/goal/adaptive_elements.h"
#include "fem/space/polynomials.h"
#include "tests/fem/rooms.h"

/// Random rooms, goals in them, and what solutions say of those.
namespace interflect::fem::test {

using solvers::ColumnMatrix;

/// A room, its lamp a part of the ceiling's plane below it, with a body that hides parts of walls; walls of their own
/// colours.
inline scene::Scene random_box(std::mt19937& random) {
  std::uniform_real_distribution<double> part(0, 1);
  const auto reflectance = [&] { return .2 + .6 * part(random); };
  const Vec3 size(1.5 + part(random), 1.2 + part(random), 1 + .5 * part(random));
  const Vec3 x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  Room room;
  room.wall(Vec3::Zero(), x, y, 1, reflectance());
  room.wall(z, y, x, 1, reflectance(), part(random) < .5 ? 1 : 0);
  room.wall(Vec3::Zero(), y, z, 1, reflectance(), .3);
  room.wall(x, z, y, 1, reflectance());
  room.wall(Vec3::Zero(), z, x, 1, reflectance());
  room.wall(y, x, z, 1, reflectance(), part(random));
  const Vec3 corner(.2 * size.x() + .2 * part(random), .2 * size.y() + .2 * part(random), .15 + .1 * part(random));
  room.box(corner, {.3 + .2 * part(random), .3 + .2 * part(random), .3 + .2 * part(random)}, 1, false, reflectance());
  return room.finish();
}

inline RadiositySettings settings_of(int order, double tolerance = 1e-5) {
  RadiositySettings settings;
  settings.order = order;
  settings.form_factors = "analytic";
  settings.quadrature_tolerance = tolerance;
  settings.stopping.tolerance = 1e-14;
  return settings;
}

inline std::vector<Goal> goals_in(const scene::Scene& scene) {
  const Vec3 size = scene.box().sizes();
  Goal::AtPoints points;
  for (const double u : {.15, .6, .9})
    for (const double v : {.2, .75}) points.points.push_back({{u * size.x(), v * size.y(), .1}, Vec3::UnitZ(), {}});
  return {{"points", points}, {"floor", Goal::OnSurface{scene::SurfaceId{0}, scene::Side::front}}};
}

struct Solved {
  mesh::ElementMesh mesh;
  RadiosityOperator from;
  ColumnMatrix R, e, b;
  std::vector<int> degree;
};
inline Solved solved(const scene::Scene& scene, const RadiositySettings& settings, Run& run) {
  const auto rays = raycast::make_ray_caster("embree", scene);
  mesh::ElementMesh mesh = elements_of(scene, settings);
  RadiosityOperator from = assemble_operator(scene, mesh.patches(), *rays, settings, run);
  const Index f = plane_functions(settings.order), n = mesh.size();
  Solved s{std::move(mesh), std::move(from), ColumnMatrix::Zero(n * f, 1), ColumnMatrix::Zero(n * f, 1), {}, {}};
  for (Index i = 0; i < n; ++i) {
    const scene::Material& material = scene.material(s.mesh.patches()[static_cast<std::size_t>(i)].surface);
    s.R.middleRows(i * f, f).setConstant(material.reflectance[0]);
    s.e(i * f, 0) = material.exitance[0];
  }
  s.degree.assign(static_cast<std::size_t>(n), settings.order);
  solvers::SolverState state{s.e, 0};
  const solvers::Reflection R(s.R);
  solvers::make_solver("gauss-seidel")->advance({*s.from.blocks, R, s.e}, state, settings.stopping, run);
  s.b = state.x;
  return s;
}

inline DualWeighted dual_weighted_of(const Solved& s, const scene::Scene& scene, const Goal& goal,
                                     const RadiositySettings& settings, const raycast::RayCaster& rays, Run& run) {
  return dual_weighted({scene, s.mesh, settings.order, s.degree, *s.from.blocks, s.R, s.e}, s.b, goal, rays,
                       *solvers::make_solver("gauss-seidel"), settings.stopping, run);
}

}  // namespace interflect::fem::test
