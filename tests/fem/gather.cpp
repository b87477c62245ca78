#include "fem/gather.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fem/direct_light.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using test::Room;

double total(const Gathered& g) {
  double sum = 0;
  for (const GatheredElement& e : g.elements) sum += e.factor;
  return sum;
}

/// docs/truths.md 2.9: a square source two metres up, a square blocker of the same size one metre up.
struct Shadow {
  explicit Shadow(int n, bool blocked) {
    room.wall({-.5, -.5, 2}, {0, 1, 0}, {1, 0, 0}, n, 0, 1);
    if (blocked) room.screen({-.5, -.5, 1}, {1, 0, 0}, {0, 1, 0});
    scene = room.finish();
    rays = raycast::make_ray_caster("brute", scene);
  }
  Gathered at(const Vec3& x, std::uint64_t key) const {
    const std::vector<double> importance(room.patches.size(), 1.0);
    return Gather(scene, room.patches, *rays, 3)({x, Vec3::UnitZ(), std::nullopt}, key, importance);
  }
  Room room;
  scene::Scene scene;
  std::unique_ptr<raycast::RayCaster> rays;
};

TEST(Gather, of_an_open_source_is_exact) {
  const Shadow open(2, false);
  for (const test::DirectLight& row : test::direct_light) {
    const Gathered g = open.at(row.x, 1);
    EXPECT_NEAR(total(g), row.open, 1e-12);
    EXPECT_EQ(g.rays, 0u);
  }
}

// Twelve points, two meshes: 24 two-sided tests, alpha 1e-4 together: 4.7 standard errors.
TEST(Gather, of_a_blocked_source_agrees_with_the_exact_penumbra) {
  for (int n : {1, 3}) {
    const Shadow shadow(n, true);
    std::uint64_t key = 0;
    for (const test::DirectLight& row : test::direct_light) {
      const Gathered g = shadow.at(row.x, ++key);
      const Spectrum noise = irradiance_noise(g, std::vector(shadow.room.patches.size(), Spectrum(1.0)));
      EXPECT_NEAR(total(g), row.blocked, 4.7 * noise[0] + 1e-12) << row.x.transpose();
      EXPECT_LE(noise[0], 0.02 * row.open);
    }
  }
}

// Inside a closed box every point sees a full hemisphere of it, close to a wall as well, and without a single ray.
TEST(Gather, in_a_closed_room_sums_to_one) {
  Room room;
  const auto floor = scene::SurfaceId{4};
  room.box({0, 0, 0}, {2, 1, 1}, 3);
  const auto scene = room.finish();
  const auto rays = raycast::make_ray_caster("brute", scene);
  const Gather gather(scene, room.patches, *rays, 1);
  const std::vector<double> importance(room.patches.size(), 1.0);
  for (const Vec3& x : {Vec3(1, .5, 0), Vec3(1e-3, .2, 0), Vec3(1e-5, 1e-5, 0)})
    EXPECT_NEAR(total(gather({x, Vec3::UnitZ(), floor}, 1, importance)), 1.0, 1e-9);
  EXPECT_NEAR(total(gather({{.7, .4, .6}, Vec3(1, 2, -1).normalized(), std::nullopt}, 2, importance)), 1.0, 1e-12);
}

// With a body in the room the sum over all is still one: what the body hides, it replaces.
TEST(Gather, next_to_a_body_sums_to_one_within_its_noise) {
  Room room;
  room.box({0, 0, 0}, {2, 1, 1}, 4);
  room.box({.5, .3, .2}, {.4, .4, .3}, 2, false);
  const auto scene = room.finish();
  const auto rays = raycast::make_ray_caster("embree", scene);
  const Gather gather(scene, room.patches, *rays, 1);
  const std::vector<double> importance(room.patches.size(), 1.0);
  const std::vector ones(room.patches.size(), Spectrum(1.0));
  for (const Vec3& x : {Vec3(.7, .5, 0), Vec3(.4, .1, 0), Vec3(1.5, .5, 0)}) {
    const Gathered g = gather({x, Vec3::UnitZ(), scene::SurfaceId{4}}, 1, importance);
    const double noise = irradiance_noise(g, ones)[0];
    EXPECT_NEAR(total(g), 1.0, 4 * noise) << noise;
    EXPECT_LT(noise, 0.01);
  }
}

}  // namespace
}  // namespace interflect::fem
