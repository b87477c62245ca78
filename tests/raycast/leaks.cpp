#include <gtest/gtest.h>

#include "raycast/ray_caster.h"
#include "tests/support/shapes.h"

namespace interflect::raycast {
namespace {

using test::placings;

/// Rays of cosine distribution from points uniform on the fronts, facets in turn: how many meet nothing, or a back?
struct Escapes {
  int nothing = 0, back = 0;
};

Escapes escapes(const scene::Scene& scene, const RayCaster& caster, std::uint64_t rays) {
  Escapes found;
  for (std::uint64_t i = 0; i < rays; ++i) {
    core::RandomNumbers numbers(17, 2, i);
    const scene::Facet& facet = scene.facets[i % scene.facets.size()];
    const Vec3 origin = test::point_on(facet, numbers);
    const auto hit = caster.closest({origin, test::cosine_about(facet.normal, numbers), facet.normal});
    found.nothing += !hit;
    found.back += hit && hit->side == scene::Side::back;
  }
  return found;
}

scene::Scene random_room(std::uint64_t seed, const test::Placing& placing) {
  core::RandomNumbers numbers(seed, 0, 0);
  const geometry::Ring floor = test::random_star(11, numbers);
  const Eigen::Matrix3d turn = test::random_rotation(numbers);
  scene::SceneBuilder builder({"grey"});
  test::add_prism_room(builder, floor, 0.8, builder.add_material(test::diffuse("grey", 0.5, 0)),
                       [&](const Vec3& x) { return placing(turn * x); });
  return builder.finish();
}

scene::Scene sphere_room(int level) {
  scene::SceneBuilder builder({"grey"});
  builder.add_facets("sphere", test::icosphere(level, 3, true), builder.add_material(test::diffuse("grey", 0.5, 0)));
  return builder.finish();
}

TEST(RayCasters, lose_no_ray_of_a_million_in_closed_rooms_that_are_not_convex) {
  for (std::uint64_t seed : {1, 2, 3, 4}) {
    const scene::Scene scene = random_room(seed, {});
    const Escapes found = escapes(scene, *make_ray_caster("embree", scene), 250'000);
    EXPECT_EQ(found.nothing, 0) << seed;
    EXPECT_EQ(found.back, 0) << seed;
  }
}

TEST(RayCasters, lose_no_ray_of_a_million_in_a_sphere_of_facets) {
  for (int level : {1, 4}) {
    const scene::Scene scene = sphere_room(level);
    const Escapes found = escapes(scene, *make_ray_caster("embree", scene), 500'000);
    EXPECT_EQ(found.nothing, 0) << level;
    EXPECT_EQ(found.back, 0) << level;
  }
}

TEST(RayCasters, lose_no_ray_at_any_scale_or_place) {
  for (const auto& placing : placings) {
    const scene::Scene scene = random_room(5, placing);
    for (const std::string& name : ray_caster_names()) {
      const Escapes found = escapes(scene, *make_ray_caster(name, scene), name == "brute" ? 10'000 : 100'000);
      EXPECT_EQ(found.nothing, 0) << name << placing.scale;
      EXPECT_EQ(found.back, 0) << name << placing.scale;
    }
  }
}

TEST(RayCasters, lose_no_ray_that_is_aimed_at_corners_and_edges) {
  const scene::Scene scene = sphere_room(2);
  for (const std::string& name : ray_caster_names()) {
    const auto caster = make_ray_caster(name, scene);
    for (const scene::Facet& facet : scene.facets)
      for (std::size_t k = 0; k < 3; ++k)
        for (const Vec3& aim : {facet.corner[k], Vec3((facet.corner[k] + facet.corner[(k + 1) % 3]) / 2)})
          for (const Vec3& from : {Vec3(0, 0, 0), Vec3(0.1, -0.7, 1.3)})
            EXPECT_TRUE(caster->closest({from, (aim - from).normalized()})) << name;
  }
}

// Where two walls meet at an acute angle, an origin nearer than offset / tan(angle) to the edge is lifted through the
// other wall: the documented price of the one offset.  On a wall of width 1 that is this part of the rays; the count is
// Poisson's, and 5 standard deviations are exceeded with probability 3e-7 in the limit of many.
TEST(RayCasters, lose_in_an_acute_corner_no_more_than_the_offset_over_the_tangent) {
  const double angle = pi / 9;
  scene::SceneBuilder builder({"grey"});
  test::add_prism_room(builder, {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(std::cos(angle), std::sin(angle), 0)}, 1,
                       builder.add_material(test::diffuse("grey", 0.5, 0)), [](const Vec3& x) { return x; });
  const scene::Scene scene = builder.finish();
  const auto caster = make_ray_caster("embree", scene);
  const int rays = 1'000'000;
  int lost = 0;
  for (std::uint64_t i = 0; i < rays; ++i) {
    core::RandomNumbers numbers(19, 2, i);
    const double along = numbers.next(), height = numbers.next();
    const Vec3 origin(along, 0, height);
    const auto hit = caster->closest({origin, test::cosine_about(Vec3::UnitY(), numbers), Vec3::UnitY()});
    lost += !hit || hit->side == scene::Side::back;
  }
  const double expected = rays * caster->offset() / std::tan(angle);
  EXPECT_LT(lost, expected + 5 * std::sqrt(expected));
}

// A box that stands on the floor touches it in a plane.  Points of the floor under the box see only the box's inside,
// up to the very edge, and points outside never see under it.
TEST(RayCasters, let_no_light_under_a_box_that_stands_on_the_floor) {
  for (const auto& placing : placings) {
    scene::SceneBuilder builder({"grey"});
    const auto grey = builder.add_material(test::diffuse("grey", 0.5, 0));
    builder.add_box("room", {placing(Vec3(0, 0, 0)), placing(Vec3(4, 4, 3))}, grey,
                    scene::SceneBuilder::Facing::inward);
    builder.add_box("box", {placing(Vec3(1, 1, 0)), placing(Vec3(2, 2, 1))}, grey);
    const scene::Scene scene = builder.finish();
    for (const std::string& name : ray_caster_names()) {
      const auto caster = make_ray_caster(name, scene);
      for (std::uint64_t i = 0; i < 20'000; ++i) {
        core::RandomNumbers numbers(23, 2, i);
        // Distances from the foot of the wall x = 1 between 1e-4 and 1, evenly in their logarithm.
        const double inside = std::pow(10, -4 * numbers.next()), y = 1.001 + 0.998 * numbers.next();
        const Vec3 direction = test::cosine_about(Vec3::UnitZ(), numbers);
        const auto under = caster->closest({placing(Vec3(1 + 0.999 * inside, y, 0)), direction, Vec3::UnitZ()});
        ASSERT_TRUE(under);
        EXPECT_EQ(under->side, scene::Side::back) << name << placing.scale;
        EXPECT_EQ(scene.surface(under->surface).name.substr(0, 4), "box/");
        const auto outside = caster->closest({placing(Vec3(1 - inside, y, 0)), direction, Vec3::UnitZ()});
        ASSERT_TRUE(outside);
        EXPECT_EQ(outside->side, scene::Side::front) << name << placing.scale;
        EXPECT_TRUE(caster->occluded(Segment{placing(Vec3(1 + 0.999 * inside, y, 0)), placing(Vec3(0.5, 0.5, 3)),
                                             Vec3::UnitZ(), -Vec3::UnitZ()}));
      }
    }
  }
}

}  // namespace
}  // namespace interflect::raycast
