#include "fem/polygon_pair_rule.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "fem/form_factor/pair_moments.h"
#include "fem/galerkin.h"
#include "tests/fem/random_pairs.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using test::Nearness;

std::vector<scene::SurfacePatch> patches_of(const test::RingPair& pair, double scale = 1) {
  std::vector<scene::SurfacePatch> patches;
  for (geometry::Ring ring : {pair.a, pair.b}) {
    for (Vec3& x : ring) x *= scale;
    patches.push_back(scene::make_patch(scene::SurfaceId{0}, scene::Side::front, ring));
  }
  return patches;
}
Eigen::MatrixXd block_of(std::span<const scene::SurfacePatch> patches, int order, int points) {
  return galerkin_block(space_on(patches, order), 0, 1, SpaceKernel(), PolygonPairRule(points));
}
double of_constants(std::span<const scene::SurfacePatch> patches, int points) {
  return block_of(patches, 0, points)(0, 0);
}

// Whatever two polygons share: what the whole set of weights sums to, and that nodes are where the panels are.
TEST(PolygonPairRule, has_weights_that_sum_to_both_areas) {
  test::RandomPairs random(3);
  for (const Nearness nearness : {Nearness::common_corner, Nearness::common_edge, Nearness::near, Nearness::far})
    for (int k = 0; k < 10; ++k) {
      const Space space = space_on(patches_of(random.pair(nearness)), 0);
      const Panel &a = space.panel(0), &b = space.panel(1);
      double sum = 0;
      PolygonPairRule(4).for_nodes(a, b, [&](const PairNode& node) {
        sum += node.weight * jacobian(a.ring(), node.u_a, node.v_a) * jacobian(b.ring(), node.u_b, node.v_b);
        for (const double u : {node.u_a, node.v_a, node.u_b, node.v_b}) {
          EXPECT_GE(u, 0);
          EXPECT_LE(u, 1);
        }
      });
      EXPECT_NEAR(sum / (a.measure * b.measure), 1, 1e-12);
    }
}

// Against closed forms (edge_pair.h, polygon_pair.h, rectangle_pair.h), which say what they err by.  What 20 points
// leave is less than what they changed, if errors halve from 16 to 20 at least: they do at any angle but the sharpest
// few degrees.
TEST(PolygonPairRule, of_random_polygons_converges_to_closed_forms_at_any_scale) {
  test::RandomPairs random(4);
  int pairs = 0, sharp = 0;
  for (const Nearness nearness : {Nearness::common_corner, Nearness::common_edge, Nearness::near, Nearness::far})
    for (int k = 0; k < 8; ++k) {
      const test::RingPair pair = random.pair(nearness);
      for (const double scale : k < 2 ? std::vector{1e-6, 1.0, 1e6} : std::vector{1.0}) {
        const auto patches = patches_of(pair, scale);
        const PairIntegral closed = PairIntegrator(patches, 1e-10)(0, 1);
        const double coarse = of_constants(patches, 16), fine = of_constants(patches, 20);
        ++pairs;
        if (std::abs(fine - coarse) > 1e-4 * closed.value && ++sharp) continue;
        EXPECT_NEAR(fine, closed.value, closed.error + std::abs(fine - coarse) + 1e-12 * closed.value)
            << static_cast<int>(nearness) << ' ' << k << ' ' << scale;
      }
    }
  EXPECT_LE(sharp, pairs / 10);
}

}  // namespace
}  // namespace interflect::fem
