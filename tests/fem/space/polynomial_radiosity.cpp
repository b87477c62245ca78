#include "fem/polynomial_radiosity.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "fem/radiosity_method.h"
#include "tests/fem/rooms.h"
#include "tests/fem/space/polynomial_settings.h"

namespace interflect::fem {
namespace {

using test::polynomial_settings;
using test::Room;

scene::Scene room_with_a_body(double reflectance, double exitance_of_floor, double exitance) {
  Room room;
  room.wall({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 1, reflectance, exitance_of_floor);
  room.wall({0, 0, 1}, {0, 2, 0}, {2, 0, 0}, 1, reflectance, exitance);
  room.wall({0, 0, 0}, {0, 2, 0}, {0, 0, 1}, 1, reflectance, exitance);
  room.wall({2, 0, 0}, {0, 0, 1}, {0, 2, 0}, 1, reflectance, exitance);
  room.wall({0, 0, 0}, {0, 0, 1}, {2, 0, 0}, 1, reflectance, exitance);
  room.wall({0, 2, 0}, {2, 0, 0}, {0, 0, 1}, 1, reflectance, exitance);
  room.box({.7, .5, .3}, {.5, .8, .4}, 1, false, reflectance, exitance);
  return room.finish();
}

std::vector<measure::Measurement> points() {
  std::vector<measure::Measurement> asked;
  for (const double x : {.1, .3, .9, 1.4, 1.9})
    for (const double y : {.2, 1.0, 1.7})
      asked.emplace_back(measure::PointIrradiance{{x, y, .0}, Vec3::UnitZ(), scene::SurfaceId{0}});
  return asked;
}

std::vector<Estimate> answers(const scene::Scene& scene, const RadiositySolution& solution, Run& run) {
  const auto rays = raycast::make_ray_caster("embree", scene);
  return RadiosityMethod(solution, *rays).answer(scene, points(), run);
}

// What emits 1 - rho everywhere in a closed room, past what hides, has radiosity 1.
TEST(PolynomialRadiosity, of_a_furnace_is_1_everywhere) {
  for (const int order : {1, 2}) {
    const scene::Scene scene = room_with_a_body(.6, .4, .4);
    core::LocalRun run(1, 2);
    const RadiositySolution s = solve_radiosity(scene, polynomial_settings(order, 1.1), run.get());
    ASSERT_TRUE(s.field);
    EXPECT_EQ(s.field->order, order);
    EXPECT_TRUE(s.closed);
    for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
      EXPECT_NEAR(s.row_sum[i], 1, 1e-4);
      EXPECT_NEAR(s.field->at(i, s.mesh.patches()[i].corner[0])[0], 1, 1e-3);
      EXPECT_NEAR(s.irradiance[i][0], 1, 3e-4);
    }
    for (const Estimate& e : answers(scene, s, run.get())) EXPECT_NEAR(e.value[0], 1, 3e-4);
  }
}

// Held against the next order on quarter the elements: errors are within what is stated, which falls with the order.
TEST(PolynomialRadiosity, errs_less_than_it_states_and_less_with_each_order) {
  const scene::Scene scene = room_with_a_body(.5, 1, 0);
  core::LocalRun run(1, 2);
  const RadiositySolution truth = solve_radiosity(scene, polynomial_settings(2, .28), run.get());
  const auto at_points = answers(scene, truth, run.get());
  double stated_before = 1e9, error_before = 1e9;
  for (const int order : {0, 1, 2}) {
    const RadiositySolution s = solve_radiosity(scene, polynomial_settings(order, .55), run.get());
    double stated = 0, error = 0;
    int beyond = 0, count = 0;
    for (const scene::SurfaceId id : scene.surface_ids()) {
      const double off = std::abs(test::mean_over(s, s.irradiance, id) - test::mean_over(truth, truth.irradiance, id));
      const double bound = test::mean_over(s, s.irradiance_error, id);
      beyond += off > bound + test::mean_over(truth, truth.irradiance_error, id);
      ++count;
    }
    const auto mine = answers(scene, s, run.get());
    for (std::size_t k = 0; k < mine.size(); ++k) {
      const double off = std::abs(mine[k].value[0] - at_points[k].value[0]);
      beyond += off > mine[k].error_bound[0] + 3 * mine[k].standard_error[0] + at_points[k].error_bound[0];
      stated += mine[k].error_bound[0] / static_cast<double>(mine.size());
      error += off / static_cast<double>(mine.size());
      ++count;
    }
    EXPECT_LE(beyond, count / 20) << order;
    EXPECT_LT(stated, stated_before / 1.5) << order;
    EXPECT_LT(error, error_before / 1.5) << order;
    stated_before = stated;
    error_before = error;
  }
}

TEST(PolynomialRadiosity, says_in_a_sentence_what_it_does_not_go_with) {
  const scene::Scene scene = room_with_a_body(.5, 1, 0);
  core::LocalRun run(1, 1);
  const auto said = [&](const RadiositySettings& settings) -> std::string {
    try {
      solve_radiosity(scene, settings, run.get());
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "";
  };
  RadiositySettings settings = polynomial_settings(1, 1.1);
  settings.closure = "scaling";
  EXPECT_EQ(said(settings), "polynomials of order 1: they do not go with a closure that is restored");
  settings = polynomial_settings(2, 1.1);
  settings.form_factors = "hemicube";
  EXPECT_EQ(said(settings),
            "form factors by 'hemicube': they are of constants: --order 0, or analytic, gauss-lambert or duffy, expected");
}

}  // namespace
}  // namespace interflect::fem
