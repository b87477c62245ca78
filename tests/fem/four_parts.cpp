#include "fem/form_factor/four_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/random.h"
#include "fem/form_factor/adaptive_lambert.h"
#include "fem/form_factor/rectangle_pair.h"
#include "geometry/polygon.h"

namespace interflect::fem {
namespace {

using Part = std::array<Vec3, 4>;

Part stretched(core::RandomNumbers& random, std::size_t corners, double width) {
  const auto jitter = [&] { return 0.3 * (2 * random.next() - 1); };
  Part part = corners == 3 ? Part{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(random.next(), 1, 0), Vec3::Zero()}
                           : Part{Vec3(0, 0, 0), Vec3(1, jitter(), 0), Vec3(1 + width * jitter(), 1, 0),
                                  Vec3(0, 1 + jitter(), 0)};
  const double turn = 2 * pi * random.next();
  for (Vec3& x : part)
    x = {std::cos(turn) * x.x() - std::sin(turn) * width * x.y(),
         std::sin(turn) * x.x() + std::cos(turn) * width * x.y(), 2};
  return part;
}

TEST(FourParts, cover_the_whole_and_keep_its_side) {
  core::RandomNumbers random(3, 0, 0);
  for (const std::size_t corners : {3u, 4u})
    for (const double width : {1.0, 0.3, 1e-2, 1e-6})
      for (int k = 0; k < 200; ++k) {
        const Part whole = stretched(random, corners, width);
        const Vec3 area = geometry::vector_area({whole.data(), corners});
        Vec3 sum = Vec3::Zero();
        for (const CellPart& part : four_parts({whole.data(), corners})) {
          const Vec3 of_part = geometry::vector_area(part.ring());
          EXPECT_GT(of_part.dot(area), -1e-12 * area.squaredNorm());
          sum += of_part;
        }
        EXPECT_LT((sum - area).norm(), 1e-9 * area.norm());
      }
}

double longest_side(std::span<const Vec3> ring) {
  double longest = 0;
  for (std::size_t k = 0; k < ring.size(); ++k)
    longest = std::max(longest, (ring[(k + 1) % ring.size()] - ring[k]).norm());
  return longest;
}

// 4^-3 of the length, but for what a corner amid the long side takes to begin with.
TEST(FourParts, of_slivers_are_a_quarter_as_long_each_time) {
  core::RandomNumbers random(3, 1, 0);
  for (const std::size_t corners : {3u, 4u})
    for (int k = 0; k < 50; ++k) {
      const Part whole = stretched(random, corners, 1e-5);
      std::vector<CellPart> parts{{whole, corners}};
      for (int depth = 0; depth < 3; ++depth) {
        std::vector<CellPart> next;
        for (const CellPart& part : parts)
          for (const CellPart& of_it : four_parts(part.ring())) next.push_back(of_it);
        parts = next;
      }
      double most = 0;
      for (const CellPart& part : parts) most = std::max(most, longest_side(part.ring()));
      EXPECT_LT(most, 1.5 / 32 * longest_side({whole.data(), corners}));
    }
}

TEST(FourParts, of_what_has_no_area_are_where_it_is) {
  const Vec3 a(1, 2, 3), b(2, 2, 3), c(4, 2, 3);
  for (const std::vector<Vec3>& ring :
       std::vector<std::vector<Vec3>>{{a, a, a}, {a, b, b}, {a, c, b}, {a, a, a, a}, {a, b, c, c}}) {
    std::vector<CellPart> parts;
    for (const CellPart& part : four_parts(ring))
      for (const CellPart& of_it : four_parts(part.ring())) parts.push_back(of_it);
    for (const CellPart& part : parts)
      for (const Vec3& x : part.ring()) EXPECT_LE((x - Vec3(2.5, 2, 3)).norm(), 1.5);
  }
}

// Strips of 1 x 0.001, 0.05 apart: quarters would need (1 / 0.05)² cells and more.
TEST(FourParts, strips_are_integrated_along_their_length) {
  const Part low{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1e-3, 0), Vec3(0, 1e-3, 0)};
  const Part high{Vec3(0, 0, .05), Vec3(0, 1e-3, .05), Vec3(1, 1e-3, .05), Vec3(1, 0, .05)};
  const Integral found = adaptive_lambert(low, Vec3::UnitZ(), high, LambertEffort{1e-6, 64});
  const std::optional<Integral> exact = rectangle_pair(low, high);
  ASSERT_TRUE(exact);
  EXPECT_LE(found.error, 1e-6 * found.value);
  EXPECT_NEAR(found.value, exact->value, 1e-6 * exact->value);
}

}  // namespace
}  // namespace interflect::fem
