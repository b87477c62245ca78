#include "fem/residual.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fem/rooms.h"
#include "tests/fem/space/polynomial_settings.h"

namespace interflect::fem {
namespace {

using test::polynomial_settings;
using test::Room;

scene::Scene lit_room(double scale) {
  Room room;
  room.box(Vec3::Zero(), scale * Vec3(2, 3, 1.2), 1, true, .6);
  room.wall(scale * Vec3(.5, .5, 1.1), scale * Vec3(0, .5, 0), scale * Vec3(.5, 0, 0), 1, 0, 5);
  room.box(scale * Vec3(.7, .5, .3), scale * Vec3(.5, .8, .4), 1, false, .3);
  return room.finish();
}

// Everything emits 1 - rho and has radiosity 1: nothing is left of the equation, but what form factors err.
TEST(Residual, of_a_furnace_is_nothing) {
  Room room;
  room.box(Vec3::Zero(), {2, 3, 1.2}, 1, true, .6, .4);
  room.box({.7, .5, .3}, {.5, .8, .4}, 1, false, .6, .4);
  const scene::Scene scene = room.finish();
  core::LocalRun run(1, 2);
  for (const int order : {0, 1}) {
    const ResidualNorms found =
        residual_norms(scene, solve_radiosity(scene, polynomial_settings(order, 2, 1e-5), run.get()), run.get());
    EXPECT_LT(found.largest[0], 1e-4) << order;
    EXPECT_NEAR(found.largest_bound[0], found.largest[0] / .4, 1e-12);
    EXPECT_LE(found.rms[0], found.largest[0]);
  }
}

// The bound holds against a far better solution, is no more than 1 / (1 - rho) above what it bounds, and is the same at
// any scale.
TEST(Residual, bounds_the_error) {
  for (const double scale : {1e-6, 1., 1e6}) {
    const scene::Scene scene = lit_room(scale);
    core::LocalRun run(1, 2);
    const RadiositySolution truth = solve_radiosity(scene, polynomial_settings(2, .45 * scale, 1e-4), run.get());
    for (const int order : {0, 1}) {
      if (order == 0 && scale != 1) continue;
      const RadiositySolution s = solve_radiosity(scene, polynomial_settings(order, 1.5 * scale, 1e-5), run.get());
      const ResidualNorms found = residual_norms(scene, s, run.get());
      double squares = 0, area = 0;
      for (std::size_t i = 0; i < truth.radiosity.size(); ++i) {
        const scene::SurfacePatch& patch = truth.mesh.patches()[i];
        const auto there =
            s.mesh.locate({patch.surface, patch.side, 0, Vec2::Zero(), patch.centroid(), patch.normal()});
        ASSERT_TRUE(there);
        const std::size_t k = there->element.value;
        const double d = truth.field->at(i, patch.centroid())[0] -
                         (s.field ? s.field->at(k, patch.centroid())[0] : s.radiosity[k][0]);
        squares += patch.area * d * d;
        area += patch.area;
        EXPECT_LT(std::abs(d), found.largest_bound[0]) << order << ' ' << scale;
      }
      const double error = std::sqrt(squares / area);
      EXPECT_LT(error, found.rms_bound[0]) << order << ' ' << scale;
      EXPECT_GT(3 * error, found.rms_bound[0]) << order << ' ' << scale;
    }
  }
}

TEST(Residual, bounds_nothing_where_nothing_is_absorbed) {
  Room room;
  room.box(Vec3::Zero(), {2, 3, 1.2}, 1, true, 1);
  room.wall({.5, .5, 1.1}, {0, .5, 0}, {.5, 0, 0}, 1, 0, 5);
  const scene::Scene scene = room.finish();
  core::LocalRun run(1, 2);
  const ResidualNorms found =
      residual_norms(scene, solve_radiosity(scene, polynomial_settings(0, 2, 1e-3), run.get()), run.get());
  EXPECT_TRUE(std::isinf(found.rms_bound[0]));
  EXPECT_TRUE(std::isfinite(found.rms[0]));
}

}  // namespace
}  // namespace interflect::fem
