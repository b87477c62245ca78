#include "fem/form_factor/far_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "fem/form_factor/adaptive_lambert.h"

namespace interflect::fem {
namespace {

class RandomPairs {
 public:
  scene::SurfacePatch patch(double size) {
    const double height = 2 * next() - 1, angle = 2 * pi * next(), radius = std::sqrt(1 - height * height);
    const Vec3 n(radius * std::cos(angle), radius * std::sin(angle), height), u = n.unitOrthogonal(), v = n.cross(u);
    const Vec3 a = .5 * size * u, b = .5 * size * (.25 + .75 * next()) * v;
    if (next() < .5)
      return scene::make_patch({0}, scene::Side::front, std::array<Vec3, 4>{-a - b, a - b, a + b, -a + b});
    return scene::make_patch({0}, scene::Side::front, std::array<Vec3, 3>{-a - b, a - b, (2 * next() - 1) * a + b});
  }
  Vec3 direction() { return patch(1).normal(); }
  double next() { return random_.next(); }

 private:
  core::RandomNumbers random_{11, 0, 0};
};

/// (max - min) / (max + min) of the heights over a plane; nothing where one is below.
std::optional<double> variation(const ElementShape& shape, const geometry::Plane& plane) {
  double low = plane.distance(shape.corner[0]), high = low;
  for (const Vec3& p : shape.ring()) low = std::min(low, plane.distance(p)), high = std::max(high, plane.distance(p));
  if (low < 0) return std::nullopt;
  return (high - low) / (high + low);
}

// 2 000 pairs of triangles and quads whose sizes differ by up to ten, at all distances down to touching balls.
TEST(FarField, errors_stay_below_their_bounds) {
  RandomPairs random;
  for (int found = 0; found < 2000;) {
    auto a = random.patch(1), b = random.patch(std::pow(10.0, 2 * random.next() - 1));
    const Vec3 offset = std::pow(30.0, random.next()) * (.5 + .5 * std::sqrt(b.area)) * random.direction();
    for (Vec3& p : b.corner) p += offset;
    const std::vector patches = {a, b};
    const ElementShapes shapes(patches);
    const double q = (shapes[0].radius + shapes[1].radius) / (shapes[0].centroid - shapes[1].centroid).norm();
    const auto of_a = variation(shapes[0], shapes[1].plane), of_b = variation(shapes[1], shapes[0].plane);
    if (!of_a || !of_b || q > .95) continue;
    ++found;
    const double exact = adaptive_lambert(shapes[0].ring(), shapes[0].plane.normal, shapes[1].ring(), 1e-9).value;
    for (int level = 0; level < ElementShapes::levels; ++level) {
      const double K = far_field(shapes.nodes(0, level), shapes[0].plane, shapes.nodes(1, level), shapes[1].plane);
      EXPECT_LE(std::abs(K / exact - 1), far_field_error(level, q, std::max(*of_a, *of_b)) + 1e-8) << level << " " << q;
    }
  }
}

TEST(FarField, levels_are_the_cheapest_that_will_do) {
  EXPECT_EQ(far_field_level(1e-4, 0, 1e-3), 0);
  EXPECT_EQ(far_field_level(.1, .1, 1e-3), 1);
  EXPECT_EQ(far_field_level(.3, .3, 1e-3), 2);
  EXPECT_EQ(far_field_level(.9, 1, 1e-3), ElementShapes::levels);
  EXPECT_EQ(far_field_level(std::nan(""), 1, 1e-3), ElementShapes::levels);
}

}  // namespace
}  // namespace interflect::fem
