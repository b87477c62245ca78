#include "fem/dark_solution.h"

#include <gtest/gtest.h>

#include <chrono>

#include "core/error.h"
#include "core/seconds_since.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using test::Room;

scene::Scene room(double exitance, double scale = 1) {
  Room room;
  room.box({0, 0, 0}, Vec3(2, 1, 1) * scale, 1, true, .6, exitance);
  room.box(Vec3(.8, .3, .1) * scale, Vec3(.4, .3, .3) * scale, 1, false, .4);
  return room.finish();
}

void expect_zero(const RadiositySolution& s) {
  ASSERT_GT(s.mesh.size(), 0);
  for (const auto* values : {&s.exitance, &s.radiosity, &s.irradiance, &s.irradiance_error, &s.irradiance_noise,
                             &s.field_error, &s.coarse_radiosity}) {
    ASSERT_EQ(std::ssize(*values), s.mesh.size());
    for (const Spectrum& value : *values) EXPECT_TRUE(value.is_zero());
  }
  EXPECT_EQ(s.solver.why, solvers::SolverReport::Stopped::nothing_to_do);
  EXPECT_TRUE(s.solver.converged());
  EXPECT_TRUE(s.closed);
  EXPECT_TRUE(s.energy.emitted.is_zero() && s.energy.absorbed.is_zero() && s.energy.residual.is_zero());
}

TEST(DarkSolution, is_there_where_nothing_emits) {
  EXPECT_TRUE(is_dark(room(0)));
  EXPECT_FALSE(is_dark(room(1e-9)));
}

// Of any solver, order and place of unknowns, with groups and for a goal, at any scale: no pair of elements is looked
// at, so that 25 000 elements take a moment, whose form factors would take a minute and 3 GB.
TEST(DarkSolution, is_zero_at_once) {
  core::LocalRun run(1, 2);
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const char* solver : {"automatic", "southwell", "stochastic-jacobi"}) {
      RadiositySettings settings;
      settings.solver = solver;
      settings.element_size = .02 * scale;
      settings.light_groups = true;
      const auto start = std::chrono::steady_clock::now();
      const Forecast forecast = fem::forecast(room(0, scale), settings, run);
      const RadiositySolution s = solve_radiosity(room(0, scale), settings, run);
      EXPECT_LT(core::seconds_since(start), 5) << solver;
      EXPECT_GT(s.mesh.size(), 25'000);
      EXPECT_EQ(forecast.elements, static_cast<double>(s.mesh.size()));
      EXPECT_EQ(s.pairs.clear + s.pairs.sampled + s.pairs.facing_away, 0u);
      EXPECT_TRUE(s.of_groups.empty());
      expect_zero(s);
    }
}

TEST(DarkSolution, is_zero_of_polynomials_and_values_at_nodes) {
  core::LocalRun run(1, 2);
  for (const int order : {1, 3}) {
    RadiositySettings settings;
    settings.order = order;
    settings.form_factors = "analytic";
    expect_zero(solve_radiosity(room(0), settings, run));
  }
  RadiositySettings at_vertices;
  at_vertices.projection = Projection::vertices;
  at_vertices.order = 1;
  expect_zero(solve_radiosity(room(0), at_vertices, run));
}

TEST(DarkSolution, has_elements_for_a_goal_in_one_pass) {
  core::LocalRun run(1, 2);
  const scene::Scene scene = room(0);
  RadiositySettings settings;
  settings.order = 2;
  settings.form_factors = "analytic";
  settings.adaptive = AdaptiveSettings{Goal{"floor", Goal::OnSurface{scene::SurfaceId{0}, scene::Side::front}}, .01};
  const RadiositySolution s = solve_radiosity(scene, settings, run);
  expect_zero(s);
  ASSERT_TRUE(s.adaptation.has_value());
  EXPECT_EQ(s.adaptation->why, AdaptiveStop::no_light);
  ASSERT_EQ(s.adaptation->passes.size(), 1u);
  EXPECT_EQ(s.adaptation->passes[0].unknowns, 6 * s.mesh.size());
  ASSERT_TRUE(s.field.has_value());
  EXPECT_TRUE(s.field->at(0, s.mesh.patches()[0].centroid()).is_zero());
}

// Where there are mirrors alone there are no elements, whatever their size would be: by any way to solve.
TEST(DarkSolution, refuses_what_has_no_elements) {
  scene::SceneBuilder builder({"y"}, scene::Quantity::radiometric);
  scene::Material mirror;
  mirror.finish = scene::Mirror{Spectrum(.9)};
  builder.add_box("room", {Vec3(0, 0, 0), Vec3(1, 1, 1)}, builder.add_material(mirror),
                  scene::SceneBuilder::Facing::inward);
  const scene::Scene scene = builder.finish();
  core::LocalRun run;
  for (const double size : {0.0, .5})
    for (const char* solver : {"automatic", "stochastic-jacobi"}) {
      RadiositySettings settings;
      settings.element_size = size;
      settings.solver = solver;
      EXPECT_THROW(solve_radiosity(scene, settings, run), core::InputError) << solver << size;
    }
}

// What does not go together is refused in the dark too.
TEST(DarkSolution, refuses_what_a_solve_does) {
  core::LocalRun run;
  RadiositySettings settings;
  settings.order = 1;
  settings.closure = "least-squares";
  EXPECT_THROW(solve_radiosity(room(0), settings, run), core::InputError);
  RadiositySettings by_rays;
  by_rays.solver = "stochastic-jacobi";
  by_rays.drop_below = 1e-4;
  EXPECT_THROW(solve_radiosity(room(0), by_rays, run), core::InputError);
}

}  // namespace
}  // namespace interflect::fem
