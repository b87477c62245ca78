#include "fem/goal/dual_weighted.h"

#include <gtest/gtest.h>

#include <random>

#include "fem/goal/adaptive_elements.h"
#include "fem/space/polynomials.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;
using test::Room;

/// A room, its lamp a part of the ceiling's plane below it, with a body that hides parts of walls; walls of their own
/// colours.
scene::Scene random_room(std::mt19937& random) {
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

RadiositySettings settings_of(int order, double tolerance = 1e-5) {
  RadiositySettings settings;
  settings.order = order;
  settings.form_factors = "analytic";
  settings.quadrature_tolerance = tolerance;
  settings.stopping.tolerance = 1e-14;
  return settings;
}

std::vector<Goal> goals_in(const scene::Scene& scene) {
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
Solved solved(const scene::Scene& scene, const RadiositySettings& settings, Run& run) {
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

// J(B_h) = <z_h, e>, whatever the mesh and the goal.
TEST(DualWeighted, finds_the_goal_by_importance_alone) {
  std::mt19937 random(5);
  for (const int order : {1, 2})
    for (int k = 0; k < 3; ++k) {
      const scene::Scene scene = random_room(random);
      const auto rays = raycast::make_ray_caster("embree", scene);
      core::LocalRun run(1, 2);
      RadiositySettings settings = settings_of(order, 1e-3);
      settings.element_size = 1.1;
      const Solved s = solved(scene, settings, run.get());
      for (const Goal& goal : goals_in(scene)) {
        const DualWeighted found =
            dual_weighted({scene, s.mesh, order, s.degree, *s.from.blocks, s.R, s.e}, s.b, goal, *rays,
                          *solvers::make_solver("gauss-seidel"), settings.stopping, run.get());
        EXPECT_GT(found.value[0], 0);
        EXPECT_NEAR(found.by_importance[0], found.value[0], 1e-12 * found.value[0]) << goal.name;
        Spectrum sum;
        for (const Spectrum& eta : found.of_elements) sum += eta;
        EXPECT_NEAR(sum[0], found.correction[0], 1e-12 * found.value[0]);
      }
    }
}

DualWeighted found(const scene::Scene& scene, const Goal& goal, int order, double element_size) {
  const auto rays = raycast::make_ray_caster("embree", scene);
  core::LocalRun run(1, 2);
  RadiositySettings settings = settings_of(order, 1e-5);
  settings.element_size = element_size;
  const Solved s = solved(scene, settings, run.get());
  return dual_weighted({scene, s.mesh, order, s.degree, *s.from.blocks, s.R, s.e}, s.b, goal, *rays,
                       *solvers::make_solver("gauss-seidel"), settings.stopping, run.get());
}

// Held against order 2 on smaller elements: estimate over error is between 0.5 and 3 in nine of ten.
TEST(DualWeighted, is_as_large_as_the_error) {
  std::mt19937 random(11);
  int count = 0, fine = 0;
  for (int k = 0; k < 10; ++k) {
    const scene::Scene scene = random_room(random);
    for (const Goal& goal : goals_in(scene)) {
      const DualWeighted coarse = found(scene, goal, 1, .9), truth = found(scene, goal, 2, .45);
      const double error = truth.value[0] - coarse.value[0], effectivity = coarse.correction[0] / error;
      ++count;
      fine += effectivity > .5 && effectivity < 3;
    }
  }
  EXPECT_GE(fine, 0.9 * count);
}

}  // namespace
}  // namespace interflect::fem
