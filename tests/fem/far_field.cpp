#include "fem/form_factor/far_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

bool in_front(const ElementShape& shape, const geometry::Plane& plane) {
  const auto ring = shape.ring();
  return std::all_of(ring.begin(), ring.end(), [&](const Vec3& p) { return plane.distance(p) >= 0; });
}

// 2 000 pairs of triangles and quads whose sizes differ by up to ten, at all distances down to touching balls: with a
// probability of 99 % each, at most 1 % + 4 sigma are worse than stated, and the median is not far below.
TEST(FarField, errors_are_below_what_is_stated_in_99_percent_and_not_far_below) {
  RandomPairs random;
  constexpr int pairs = 2000;
  std::array<int, ElementShapes::levels> worse{};
  std::array<std::vector<double>, ElementShapes::levels> ratios;
  for (int found = 0; found < pairs;) {
    auto a = random.patch(1), b = random.patch(std::pow(10.0, 2 * random.next() - 1));
    const Vec3 offset = std::pow(30.0, random.next()) * (.5 + .5 * std::sqrt(b.area)) * random.direction();
    for (Vec3& p : b.corner) p += offset;
    const std::vector patches = {a, b};
    const ElementShapes shapes(patches);
    const FarPair pair = far_pair(shapes[0], shapes[1]);
    if (!in_front(shapes[0], shapes[1].plane) || !in_front(shapes[1], shapes[0].plane) || pair.q() > .7) continue;
    ++found;
    const double exact = adaptive_lambert(shapes[0].ring(), shapes[0].plane.normal, shapes[1].ring(), 1e-12).value;
    const auto K = [&](int level) {
      return far_field(shapes.nodes(0, level), shapes[0].plane, shapes.nodes(1, level), shapes[1].plane);
    };
    for (int level = 1; level < ElementShapes::levels; ++level) {
      const double error = std::abs(K(level) - exact),
                   stated = far_field_error(level, pair, K(level) - K(level - 1), K(level));
      if (error < 1e-11 * exact) continue;  // rounding, and that of the reference
      worse[static_cast<std::size_t>(level)] += error > stated;
      ratios[static_cast<std::size_t>(level)].push_back(stated / error);
    }
  }
  for (std::size_t level = 1; level < ElementShapes::levels; ++level) {
    std::vector<double>& r = ratios[level];
    ASSERT_GT(r.size(), 500u);
    EXPECT_LE(worse[level], 0.01 * static_cast<double>(r.size()) + 4 * std::sqrt(0.01 * static_cast<double>(r.size())))
        << level;
    std::nth_element(r.begin(), r.begin() + static_cast<Index>(r.size() / 2), r.end());
    EXPECT_LT(r[r.size() / 2], level == 3 ? 15 : 8) << level;
  }
}

TEST(FarField, levels_start_where_they_may_do) {
  const auto pair = [](double q, bool triangles, double cosine = 1) {
    return FarPair{{q / 2, triangles}, {q / 2, triangles}, cosine};
  };
  EXPECT_EQ(far_field_level(pair(1e-4, false), 1e-3), 1);
  EXPECT_EQ(far_field_level(pair(.4, false), 1e-5), 2);
  EXPECT_EQ(far_field_level(pair(.2, false), 1e-5), 2);
  EXPECT_EQ(far_field_level(pair(.2, false, 0), 1e-5), 3) << "edge-on";
  EXPECT_EQ(far_field_level(pair(.4, true), 1e-5), 1);
  EXPECT_EQ(far_field_level(pair(.9, false), 1e-3), ElementShapes::levels);
  EXPECT_EQ(far_field_level(pair(std::nan(""), false), 1e-3), ElementShapes::levels);
}

}  // namespace
}  // namespace interflect::fem
