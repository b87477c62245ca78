#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using test::form_factors;
using test::Room;

/// F_12 of two patches alone in the world.
double form_factor(const scene::SurfacePatch& a, const scene::SurfacePatch& b, double tolerance) {
  const std::vector patches = {a, b};
  Room nothing;
  nothing.screen({1e3, 1e3, 1e3}, {1, 0, 0}, {0, 1, 0});
  return form_factors(nothing.finish(), patches, tolerance).K(0, 1) / a.area;
}

scene::SurfacePatch patch(std::uint32_t surface, const std::vector<Vec3>& ring) {
  return scene::make_patch({surface}, scene::Side::front, ring);
}
scene::SurfacePatch unit_square() { return patch(0, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}); }

// docs/truths.md 2.11: V1, V2, V10, V8, V11; the tolerance asked for bounds the error.
TEST(FormFactors, agree_with_published_closed_forms) {
  const auto above = patch(1, {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}});
  const auto beside = patch(1, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}});
  const auto triangle = patch(0, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const auto v8_floor = patch(0, {{.2, 0, 0}, {1.2, 0, 0}, {1.2, 1, 0}, {.2, 1, 0}});
  const auto v8_wall = patch(1, {{0, .4, .3}, {0, 2, .3}, {0, 2, 1.5}, {0, .4, 1.5}});
  const auto low = patch(0, {{.1, .3, 0}, {.6, .3, 0}, {.6, .9, 0}, {.1, .9, 0}});
  const auto high = patch(1, {{.5, .2, .7}, {.5, .8, .7}, {1.3, .8, .7}, {1.3, .2, .7}});
  for (double tolerance : {1e-3, 1e-6, 1e-9}) {
    const auto expect = [&](double computed, double exact) {
      EXPECT_NEAR(computed / exact, 1.0, tolerance + 1e-11) << tolerance;
    };
    expect(form_factor(unit_square(), above, tolerance), 0.19982489569838738);
    expect(form_factor(unit_square(), beside, tolerance), 0.20004377607540315);
    expect(form_factor(triangle, patch(1, {{0, 0, 1}, {0, 2, 1}, {2, 0, 1}}), tolerance), 0.284312520989);
    expect(form_factor(triangle, patch(1, {{.2, .1, .8}, {.3, 1.2, 1.1}, {1.1, .3, 1.4}}), tolerance), 0.083671221476);
    expect(form_factor(v8_floor, v8_wall, tolerance), 0.117161328423);
    expect(form_factor(low, high, tolerance) * low.area, 0.03513229219968);
  }
}

// A wall that goes through the floor's plane exchanges only what lies above; one that faces away, nothing.
TEST(FormFactors, are_of_the_parts_in_front_of_each_other) {
  const auto through = patch(1, {{0, 0, -2}, {0, 1, -2}, {0, 1, 1}, {0, 0, 1}});
  EXPECT_NEAR(form_factor(unit_square(), through, 1e-8), 0.20004377607540315, 2e-9);
  const auto away = patch(1, {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}});
  EXPECT_EQ(form_factor(unit_square(), away, 1e-3), 0.0);
  const auto coplanar = patch(1, {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}});
  EXPECT_EQ(form_factor(unit_square(), coplanar, 1e-3), 0.0);
}

// A_1 F_12 = A_2 F_21 holds by construction; that F is divided by the right area shows where areas differ: a small
// disc-like patch of side .01 under a large one sees all of it, F = Lambert's at its centre to (side/distance)², the
// other way 10^-4 of that.
TEST(FormFactors, of_very_unequal_areas_are_divided_by_the_area_that_sends) {
  const auto small = patch(0, {{.495, .495, 0}, {.505, .495, 0}, {.505, .505, 0}, {.495, .505, 0}});
  const auto large = patch(1, {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}});
  EXPECT_NEAR(form_factor(small, large, 1e-8), 0.2394564705, 2e-5);
  EXPECT_NEAR(form_factor(large, small, 1e-8), 0.2394564705e-4, 2e-9);
}

// Row sums of closed boxes, whatever their shape: elements of area ratios 1 to 400, touching along edges.
TEST(FormFactors, of_a_closed_box_sum_to_one) {
  for (const Vec3& size : {Vec3(1, 1, 1), Vec3(1, 5, 20), Vec3(.1, 1, 2)}) {
    Room room;
    room.box(Vec3::Zero(), size, 3);
    const auto scene = room.finish();
    const auto F = form_factors(scene, room.patches, 1e-7);
    EXPECT_EQ(F.pairs.sampled, 0u) << "a convex room is proved clear";
    for (std::size_t i = 0; i < room.patches.size(); ++i)
      EXPECT_NEAR(F.K.row(Index(i)).sum() / room.patches[i].area, 1.0, 1e-7);
  }
}

// The bound that comes with each entry holds: against a tolerance a million times tighter.
TEST(FormFactors, come_with_bounds_on_their_quadrature_error) {
  Room room;
  room.box(Vec3::Zero(), {1, 2, 1.5}, 4);
  const auto scene = room.finish();
  const auto coarse = form_factors(scene, room.patches, 1e-2), fine = form_factors(scene, room.patches, 1e-8);
  int outside = 0, entries = 0;
  for (Index i = 0; i < coarse.K.rows(); ++i)
    for (Index j = 0; j < i; ++j) {
      const double error = std::abs(coarse.K(i, j) - fine.K(i, j));
      entries += fine.K(i, j) > 0;
      outside += error > coarse.error(i, j) + 1e-8 * fine.K(i, j);
      EXPECT_LE(error, 1e-2 * fine.K(i, j));
    }
  EXPECT_LE(outside, entries / 100);  // the difference of two rules is an estimate: it may vanish by chance
}

// Corners of mixed triangles and quads; tetrahedron: three right triangles and a slanted one.
TEST(FormFactors, of_a_closed_tetrahedron_sum_to_one) {
  const Vec3 o(0, 0, 0), a(1, 0, 0), b(0, 2, 0), c(0, 0, .5);
  const std::vector patches = {patch(0, {o, a, b}), patch(1, {o, c, a}), patch(2, {o, b, c}), patch(3, {a, c, b})};
  Room nothing;
  nothing.screen({1e3, 1e3, 1e3}, {1, 0, 0}, {0, 1, 0});
  const auto F = form_factors(nothing.finish(), patches, 1e-8);
  for (Index i = 0; i < 4; ++i) EXPECT_NEAR(F.K.row(i).sum() / patches[std::size_t(i)].area, 1.0, 1e-8);
}

}  // namespace
}  // namespace interflect::fem
