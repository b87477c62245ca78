#include "fem/form_factor/hemicube.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fem/aliasing.h"
#include "tests/fem/row_views.h"
#include "tests/support/shapes.h"

namespace interflect::fem {
namespace {

using fem::test::aliasing;
using fem::test::Room;
using fem::test::Views;
using fem::test::views;
using geometry::Ring;

// One view point at the centre, and so the wrong limits: methods.md 1.12; the true ones are 0.2000437761 and
// 0.1998248957.  Four standard deviations of aliasing, for edges of 2 pi together.
TEST(Hemicube, of_one_point_converges_to_its_wrong_limits) {
  Room perpendicular, parallel;
  perpendicular.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);
  perpendicular.wall({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1);
  parallel.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);
  parallel.wall({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, 1);
  const auto across = perpendicular.finish(), above = parallel.finish();
  for (const char* name : {"hemicube", "hemicube-midpoint", "hemicube-max"})
    for (const int resolution : {64, 256, 1024}) {
      const double tolerance = 4 * aliasing(HemicubeGrid::uniform(resolution), 2 * pi) +
                               (name[8] == '-' ? 0.55 / resolution / resolution : 0);
      const Views F = views(name, across, perpendicular.patches, resolution),
                  G = views(name, above, parallel.patches, resolution);
      for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 0)}) {
        EXPECT_NEAR(F.K(a, b), 0.1901358824, tolerance) << name << " " << resolution;
        EXPECT_NEAR(G.K(a, b), 0.2394564705, tolerance) << name << " " << resolution;
        EXPECT_LT(std::abs(F.K(a, b) - 0.2000437761), F.bound(a, b)) << name << " " << resolution;
        EXPECT_LT(std::abs(G.K(a, b) - 0.1998248957), G.bound(a, b)) << name << " " << resolution;
      }
    }
}

TEST(Hemicube, rows_of_a_closed_room_with_bodies_sum_to_one) {
  Room room = fem::test::room_with_bodies(12, 2);  // fine enough for K <= min(A_a, A_b) to hold by itself
  const auto scene = room.finish();
  for (const char* name : {"hemicube", "hemicube-max"}) {
    const Views F = views(name, scene, room.patches, 32);
    EXPECT_EQ(F.counts.clamped, 0u);
    EXPECT_EQ(F.counts.lost, 0);
    for (Index a = 0; a < F.K.rows(); ++a)
      EXPECT_NEAR(F.K.row(a).sum() / room.patches[static_cast<std::size_t>(a)].area, 1, 1e-12) << a;
  }
}

// docs/truths.md 2.9: small floor elements, a source 2 m above them, a blocker 1 m above.  The blocker's dark back is
// what they see of it, or a side without elements.
TEST(Hemicube, dark_backs_and_surfaces_without_elements_block) {
  const std::vector<std::pair<double, double>> at{
      {0, 0}, {.6, .007557182366}, {.75, .017821902089}, {1, .029443796377}, {1.5, .032663265537}};
  for (const bool fronts : {false, true}) {
    Room room;
    for (const auto& [x, factor] : at) room.wall({x - 5e-4, -5e-4, 0}, {1e-3, 0, 0}, {0, 1e-3, 0}, 1);
    room.wall({-.5, -.5, 2}, {0, 1, 0}, {1, 0, 0}, 1);
    if (fronts)
      room.screen({-.5, -.5, 1}, {0, 1, 0}, {1, 0, 0});
    else
      room.wall({-.5, -.5, 1}, {1, 0, 0}, {0, 1, 0}, 1);
    const auto scene = room.finish();
    const Views F = views("hemicube", scene, room.patches, 512);
    for (std::size_t k = 0; k < at.size(); ++k) {
      const auto row = static_cast<Index>(k);
      EXPECT_NEAR(F.K(row, 5) * 1e6, at[k].second, F.bound(row, 5) * 1e6 + 1e-15) << k;
      EXPECT_LT(F.bound(row, 5) * 1e6, 6e-4) << k;
    }
  }
}

// Each element is an item on its own side; both sides of a thin plate are different items.
TEST(Hemicube, sides_of_a_thin_plate_are_seen_from_their_own_sides) {
  scene::SceneBuilder builder({"y"}, scene::Quantity::radiometric);
  scene::Material both{"", Spectrum(0.5), Spectrum(0.0), scene::Sides::both};
  const auto material = builder.add_material(both);
  std::vector<scene::SurfacePatch> patches;
  const auto add = [&](double z) {
    const auto plate = fem::test::parallelogram({-.5, -.5, z}, {1, 0, 0}, {0, 1, 0});
    const auto id = builder.add_polygon("plate", plate, material);
    Ring ring = plate.outer;
    patches.push_back(scene::make_patch(id, scene::Side::front, ring));
    std::reverse(ring.begin(), ring.end());
    patches.push_back(scene::make_patch(id, scene::Side::back, ring));
  };
  add(0), add(1), add(2);
  const auto scene = builder.finish();
  const Views F = views("hemicube", scene, patches, 128);
  for (Index a = 0; a < 6; ++a)
    for (Index b = 0; b < 6; ++b) {
      const bool facing = (a == 0 && b == 3) || (a == 3 && b == 0) || (a == 2 && b == 5) || (a == 5 && b == 2);
      EXPECT_NEAR(F.K(a, b), facing ? 0.23945647 : 0, 1e-3) << a << " " << b;
    }
}

// Elements on one half of a ceiling: the other half hides what is above it, and the facets beneath the elements do not
// hide them.
TEST(Hemicube, surfaces_that_elements_cover_in_part_are_seen_where_they_do_and_block_everywhere) {
  scene::SceneBuilder builder({"y"}, scene::Quantity::radiometric);
  const auto material = builder.add_material(fem::test::diffuse(0.5));
  std::vector<scene::SurfacePatch> patches;
  const auto add = [&](const Vec3& corner, const Vec3& u, const Vec3& v, const Vec3& part) {
    const auto id = builder.add_polygon("wall", fem::test::parallelogram(corner, u, v), material);
    patches.push_back(scene::make_patch(id, scene::Side::front, fem::test::parallelogram(corner, part, v).outer));
  };
  add({-5e-4, -5e-4, 0}, {1e-3, 0, 0}, {0, 1e-3, 0}, {1e-3, 0, 0});
  add({-.5, .5, 1}, {1, 0, 0}, {0, -1, 0}, {.5, 0, 0});
  add({-.5, .5, 2}, {1, 0, 0}, {0, -1, 0}, {1, 0, 0});
  const auto scene = builder.finish();
  const Views F = views("hemicube", scene, patches, 256);
  EXPECT_NEAR(F.K(0, 1) * 1e6, 0.5 * 0.2394564705, 4 * aliasing(HemicubeGrid::uniform(256), 3));
  EXPECT_EQ(F.K(0, 2), 0);
}

TEST(Hemicube, numbers_do_not_depend_on_the_blocks_and_scale_exactly_by_powers_of_two) {
  Views reference;
  for (const double scale : {1.0, 1.0 / (1 << 20), double(1 << 20)}) {
    Room room;
    room.box(scale * Vec3(0, 0, 0), scale * Vec3(5, 4, 3), 3);
    room.box(scale * Vec3(1, 1, .25), scale * Vec3(1, .75, 1.25), 2, false);
    const auto scene = room.finish();
    const auto caster = raycast::make_ray_caster("brute", scene);
    FormFactorContext context{scene, room.patches, *caster};
    context.resolution = 64;
    const auto method = make_form_factor_method("hemicube", context);
    fem::test::ViewSink one_by_one(room.patches.size());
    core::LocalRun run(1, 1);
    const auto n = static_cast<Index>(room.patches.size());
    for (Index a = n; a-- > 0;) method->exchange({room.patches, a, 1}, {room.patches, 0, n}, one_by_one, run.get());
    const Views at_once = views(*method, room.patches);
    EXPECT_EQ(one_by_one.K, at_once.K);
    EXPECT_EQ(one_by_one.bound, at_once.bound);
    if (scale == 1) reference = at_once;
    EXPECT_EQ(at_once.K / (scale * scale), reference.K) << scale;
  }
}

// Scales of 1e-6 and 1e6 round differently, and 1e9 m from the origin coordinates have steps of 1e-7 m.
TEST(Hemicube, holds_at_any_scale_and_far_from_the_origin) {
  for (const auto& placing : interflect::test::placings)
    for (const char* name : {"hemicube", "hemicube-max", "single-plane"}) {
      Room room;
      room.box(placing({0, 0, 0}), placing.scale * Vec3(4, 4, 4), 2);
      room.box(placing({1, 1, 1}), placing.scale * Vec3(1, 1, 1), 1, false);
      const auto scene = room.finish();
      const Views F = views(name, scene, room.patches, 64);
      for (Index a = 0; a < F.K.rows(); ++a)
        EXPECT_NEAR(F.K.row(a).sum() / room.patches[static_cast<std::size_t>(a)].area, 1 - F.counts.lost, 1e-6)
            << name << " " << placing.scale;
    }
}

// Near, huge, tiny, thin, edge-on, touching, coplanar, crossing, twice: finite and within bounds, whatever they are
// worth.
TEST(Hemicube, degenerate_elements_give_finite_factors_within_their_limits) {
  Room room;
  room.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);
  room.wall({-50, -50, 1e-6}, {0, 100, 0}, {100, 0, 0}, 1);  // much larger than its distance
  room.wall({1, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);             // coplanar, touching
  room.wall({.5, .5, 0}, {0, 0, 1}, {0, 1, 0}, 1);           // its foot goes through the first one's centre
  room.wall({.2, .2, 1e-7}, {0, 1e-9, 0}, {1, 0, 0}, 1);     // a sliver
  room.wall({.3, .3, 5e-7}, {0, 1e-8, 0}, {1e-8, 0, 0}, 1);  // tiny
  room.wall({.1, .1, -.5}, {.8, 0, 0}, {0, .1, 1}, 1);       // crossing
  room.wall({.1, .1, -.5}, {.8, 0, 0}, {0, .1, 1}, 1);       // and again
  room.triangle({0, 0, 2}, {1, 1e-6, 2}, {2, 0, 2});
  const auto scene = room.finish();
  for (const char* name : {"hemicube", "hemicube-midpoint", "hemicube-max", "single-plane"})
    for (const int resolution : {2, 64}) {
      const Views F = views(name, scene, room.patches, resolution);
      for (Index a = 0; a < F.K.rows(); ++a)
        for (Index b = 0; b < F.K.rows(); ++b) {
          const double most =
              std::min(room.patches[static_cast<std::size_t>(a)].area, room.patches[static_cast<std::size_t>(b)].area);
          ASSERT_TRUE(std::isfinite(F.K(a, b)) && std::isfinite(F.bound(a, b))) << name << ": " << a << " " << b;
          EXPECT_GE(F.K(a, b), 0);
          EXPECT_LE(F.K(a, b), most);
        }
    }
}

// The constants in row_method.cpp and proximity.cpp, in scenes that hide much, little and nothing.
TEST(RowMethods, true_errors_are_below_the_stated_ones_in_ninety_five_per_cent) {
  const fem::test::SolvedScenes scenes;
  for (const auto& [what, solved] : scenes.of)
    for (const char* name : {"hemicube", "hemicube-max", "single-plane"})
      for (const int resolution : {32, 256}) {
        fem::test::SceneCoverage found = fem::test::coverage(solved, name, resolution);
        EXPECT_GE(found.views.part(), 0.95) << name << " " << resolution << " " << what;
        EXPECT_GE(found.joined.part(), 0.95) << name << " " << resolution << " " << what;
        EXPECT_LE(found.views.median(), 10) << name << " " << resolution << " " << what;
      }
}

}  // namespace
}  // namespace interflect::fem
