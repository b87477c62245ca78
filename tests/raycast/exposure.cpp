#include "raycast/exposure.h"

#include <gtest/gtest.h>

#include "scene/builder.h"

namespace interflect::raycast {
namespace {

using scene::SceneBuilder;

scene::MaterialId grey(SceneBuilder& builder) {
  return builder.add_material({"grey", Spectrum(0.5), Spectrum(1.0), scene::Sides::front});
}

TEST(Exposure, a_room_seen_from_inside_shows_no_backs) {
  SceneBuilder builder({"y"});
  builder.add_box("room", geometry::Box(Vec3(0, 0, 0), Vec3(4, 3, 2)), grey(builder), SceneBuilder::Facing::inward);
  const scene::Scene scene = builder.finish();
  core::LocalRun run;
  for (const Exposure& e : exposures(scene, *make_ray_caster("embree", scene), 1000, run)) {
    EXPECT_EQ(e.backs, 0);
    EXPECT_EQ(e.nothing, 0);
  }
}

TEST(Exposure, a_flipped_wall_is_seen_as_a_back) {
  SceneBuilder builder({"y"});
  const auto material = grey(builder);
  // Unit squares face to face, the upper one flipped: the lower one sees its back in the part F12 = 0.199824895698.
  builder.add_polygon("lower", {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}}, material);
  builder.add_polygon("flipped", {{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}, {}}, material);
  const scene::Scene scene = builder.finish();
  core::LocalRun run;
  constexpr int rays = 100'000;
  const auto found = exposures(scene, *make_ray_caster("brute", scene), rays, run);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].backs, 0.199824895698, 4 * std::sqrt(0.2 * 0.8 / rays));  // alpha 6e-5
  EXPECT_NEAR(found[0].backs + found[0].nothing, 1, 1e-12);
  EXPECT_EQ(found[1].nothing, 1);  // it looks up into the void
}

}  // namespace
}  // namespace interflect::raycast
