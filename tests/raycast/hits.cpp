#include <gtest/gtest.h>

#include <cfenv>

#include "core/error.h"
#include "raycast/ray_caster.h"
#include "tests/support/shapes.h"

namespace interflect::raycast {
namespace {

/// A triangle with rational corners in the plane z = 1, facing up.
scene::Scene one_triangle() {
  scene::SceneBuilder builder({"grey"});
  const std::array<test::TriangleCorners, 1> corners{{{Vec3(0, 0, 1), Vec3(2, 0, 1), Vec3(0, 1, 1)}}};
  builder.add_facets("one", corners, builder.add_material(test::diffuse("grey", 0.5, 0)));
  return builder.finish();
}

TEST(RayCasters, tell_facet_side_normal_and_barycentric_place) {
  const scene::Scene scene = one_triangle();
  for (const std::string& name : ray_caster_names()) {
    const auto caster = make_ray_caster(name, scene);
    const Vec3 target(0.5, 0.25, 1);  // u = 0.25, v = 0.25
    for (const double above : {1.0, -1.0}) {
      const Vec3 eye(0.25, 0.5, 1 + above);
      const auto hit = caster->closest({eye, (target - eye).normalized()});
      ASSERT_TRUE(hit) << name;
      EXPECT_EQ(hit->surface.value, 0u);
      EXPECT_EQ(hit->facet, 0u);
      EXPECT_EQ(hit->side, above > 0 ? scene::Side::front : scene::Side::back);
      EXPECT_EQ(hit->normal, above * Vec3::UnitZ());
      EXPECT_LT((hit->position - target).norm(), 1e-6);
      EXPECT_LT((hit->uv - Vec2(0.25, 0.25)).norm(), 1e-6);
    }
    EXPECT_FALSE(caster->closest({Vec3(0.5, 0.25, 2), Vec3::UnitZ()})) << name;
    EXPECT_FALSE(caster->closest({Vec3(1.5, 0.5, 2), -Vec3::UnitZ()})) << name;
  }
}

TEST(RayCasters, put_hits_on_the_plane_of_their_facet_and_into_it) {
  for (const auto& placing : test::placings) {
    scene::SceneBuilder builder({"grey"});
    auto triangles = test::icosphere(2, 1, true);
    for (auto& corners : triangles)
      for (Vec3& corner : corners) corner = placing(corner);
    builder.add_facets("sphere", triangles, builder.add_material(test::diffuse("grey", 0.5, 0)));
    const scene::Scene scene = builder.finish();
    // 1e-12 of the scene, or what coordinates of the place's size resolve.
    const double resolution = std::max(1e-12 * placing.scale, 4 * 0x1p-52 * placing.shift.norm());
    for (const std::string& name : ray_caster_names()) {
      const auto caster = make_ray_caster(name, scene);
      for (std::uint64_t i = 0; i < 10'000; ++i) {
        core::RandomNumbers numbers(29, 1, i);
        const auto hit = caster->closest({placing(Vec3(0.3, -0.2, 0.1)), test::cosine_about(Vec3::UnitX(), numbers)});
        ASSERT_TRUE(hit);
        const scene::Facet& facet = scene.facets[hit->facet];
        EXPECT_LT(std::abs((hit->position - facet.corner[0]).dot(facet.normal)), resolution) << name << placing.scale;
        EXPECT_GE(hit->uv.minCoeff(), 0);
        EXPECT_LE(hit->uv.sum(), 1 + 1e-15);
      }
    }
  }
}

// Rays that leave a surface do not meet it again, even at grazing angles, and see what is further away than the offset.
TEST(RayCasters, leave_a_surface_by_the_offset_and_see_what_is_beyond_it) {
  const scene::Scene scene = one_triangle();
  for (const std::string& name : ray_caster_names()) {
    const auto caster = make_ray_caster(name, scene);
    for (std::uint64_t i = 0; i < 10'000; ++i) {
      core::RandomNumbers numbers(31, 1, i);
      const Vec3 x = test::point_on(scene.facets[0], numbers);
      EXPECT_FALSE(caster->closest({x, test::cosine_about(Vec3::UnitZ(), numbers), Vec3::UnitZ()})) << name;
      EXPECT_FALSE(caster->closest({x, Vec3::UnitX(), Vec3::UnitZ()})) << name;
      EXPECT_FALSE(caster->occluded(Segment{x, x + Vec3(0, 0, 1), Vec3::UnitZ()})) << name;
      EXPECT_TRUE(caster->occluded(Segment{x, x + Vec3(0, 0, 1), -Vec3::UnitZ()})) << name;
    }
    EXPECT_GT(caster->offset(), 0);
    EXPECT_LE(caster->offset(), 2 * 4e-6) << name;
  }
}

TEST(RayCasters, see_nothing_in_an_empty_scene) {
  const scene::Scene scene = scene::SceneBuilder({"grey"}).finish();
  for (const std::string& name : ray_caster_names()) {
    const auto caster = make_ray_caster(name, scene);
    EXPECT_FALSE(caster->closest({Vec3(0, 0, 0), Vec3::UnitX()}));
    EXPECT_FALSE(caster->occluded(Segment{Vec3(0, 0, 0), Vec3::UnitX()}));
  }
}

TEST(RayCasters, are_known_by_name_and_others_are_refused_in_one_line) {
  const scene::Scene scene = one_triangle();
  for (const std::string& name : ray_caster_names()) EXPECT_EQ(make_ray_caster(name, scene)->name(), name);
  try {
    make_ray_caster("optix", scene);
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_STREQ(error.what(), "intersector 'optix': one of embree, brute expected");
  }
}

// Denormal numbers are data here: building must not switch their flushing on (Embree does so inside).
TEST(RayCasters, leave_the_floating_point_modes_as_they_were) {
  const int rounding = std::fegetround();
  const scene::Scene scene = one_triangle();
  const auto caster = make_ray_caster("embree", scene);
  caster->closest({Vec3(0.5, 0.25, 2), -Vec3::UnitZ()});
  volatile double tiny = 1e-308;
  tiny = tiny / 16;
  EXPECT_GT(tiny, 0.0);
  tiny = tiny * 1.0;
  EXPECT_GT(tiny, 0.0);
  EXPECT_EQ(std::fegetround(), rounding);
}

}  // namespace
}  // namespace interflect::raycast
