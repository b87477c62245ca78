#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "fem/form_factor/pair_moments.h"
#include "fem/galerkin.h"
#include "fem/polygon_pair_rule.h"
#include "tests/fem/rooms.h"
#include "tests/support/shapes.h"

namespace interflect::fem {
namespace {

/// Two elements on half-planes that meet in a line at an angle, by their corners (along the line, away from it); each
/// in the order that its front wants, which is the way the other one is.
struct Pair {
  const char* name;
  std::vector<Vec2> flat, raised;
};
const std::vector<Pair> pairs{
    {"equal squares, an edge", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 0}, {0, 1}, {1, 1}, {1, 0}}},
    {"a square and a strip, an edge", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 0}, {0, .3}, {1, .3}, {1, 0}}},
    {"a square and one of half its side, a part of an edge",
     {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
     {{0, 0}, {0, .5}, {.5, .5}, {.5, 0}}},
    {"a trapezoid and a triangle, an edge", {{0, 0}, {1, 0}, {.8, .7}, {.1, .7}}, {{0, 0}, {.3, .9}, {1, 0}}},
    {"triangles, an edge", {{0, 0}, {1, 0}, {.2, .5}}, {{0, 0}, {.4, 1.2}, {1, 0}}},
    {"squares side by side, a corner", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 0}, {-1, 0}, {-1, 1}, {0, 1}}},
    {"a square and a quarter of its side, a corner",
     {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
     {{0, 0}, {-.25, 0}, {-.25, .25}, {0, .25}}},
    {"a square and one that stands on its corner",
     {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
     {{0, 0}, {-.3, .4}, {.1, .7}, {.4, .3}}},
    {"a triangle and a square that stands on its corner",
     {{0, 0}, {.6, .3}, {.2, .9}},
     {{0, 0}, {-.6, .8}, {.2, 1.4}, {.8, .6}}}};

/// In space, turned and shifted.
class Hinge {
 public:
  Hinge(const Pair& pair, double degrees, core::RandomNumbers& random) {
    const Eigen::Matrix3d turn = interflect::test::random_rotation(random);
    const Vec3 shift = interflect::test::random_point(random);
    const double angle = degrees * pi / 180;
    std::vector<Vec3> flat, raised;
    for (const Vec2& at : pair.flat) flat.push_back(turn * Vec3(at.x(), at.y(), 0) + shift);
    for (const Vec2& at : pair.raised)
      raised.push_back(turn * Vec3(at.x(), std::cos(angle) * at.y(), std::sin(angle) * at.y()) + shift);
    patches = {scene::make_patch(scene::SurfaceId{0}, scene::Side::front, flat),
               scene::make_patch(scene::SurfaceId{1}, scene::Side::front, raised)};
  }
  std::vector<scene::SurfacePatch> patches;
};

/// The blocks of a pair by quadrature alone, which shares nothing with closed forms, and what 24 points a side know
/// better than 20: errors fall by one factor with every point, so that this is far more than what 24 leave.
struct Reference {
  Eigen::MatrixXd value;
  double doubt;
};
Reference reference(const Hinge& hinge, int order) {
  const Space space = space_on(hinge.patches, order);
  const Eigen::MatrixXd value = galerkin_block(space, 0, 1, SpaceKernel(), PolygonPairRule(24)),
                        coarser = galerkin_block(space, 0, 1, SpaceKernel(), PolygonPairRule(20));
  return {value, (value - coarser).cwiseAbs().maxCoeff()};
}

// Constants are known in closed form to 1e-14 (edge_pair.h, polygon_pair.h): what the reference is held against, since
// it converges for all functions alike.  Functions of an order are the first of the next one's.
TEST(PairMoments, of_touching_elements_err_less_than_stated_entry_by_entry) {
  core::RandomNumbers random(7, 0, 0);
  for (const Pair& pair : pairs)
    for (const double degrees : {60.0, 90.0, 120.0}) {
      const Hinge hinge(pair, degrees, random);
      const Reference truth = reference(hinge, 2);
      for (const double tolerance : {1e-4, 1e-6}) {
        const PairIntegrator constants(hinge.patches, tolerance);
        const PairIntegral K = constants(0, 1);
        ASSERT_EQ(K.facing, Facing::full);
        EXPECT_NEAR(truth.value(0, 0), K.value, truth.doubt + 1e-12) << pair.name << ' ' << degrees;
        EXPECT_LT(truth.doubt, .1 * tolerance * K.value) << pair.name << ' ' << degrees;
        for (const int order : {1, 2}) {
          const MomentIntegrator moments(constants.shapes(), order, tolerance);
          const PairMoments block = moments(0, 1, K);
          // Cells to the tolerance, and a tenth of it for the irradiance inside (pair_moments.cpp).
          EXPECT_LE(block.error, 1.1 * tolerance * K.value + 1e-13);
          for (Index a = 0; a < block.value.rows(); ++a)
            for (Index b = 0; b < block.value.cols(); ++b)
              EXPECT_NEAR(block.value(a, b), truth.value(a, b), block.error + truth.doubt)
                  << pair.name << " at " << degrees << " degrees, order " << order << ": " << a << ' ' << b;
        }
      }
    }
}

// docs/truths.md 2.11, V2.
TEST(PolygonPairRule, of_perpendicular_unit_squares_are_known) {
  core::RandomNumbers random(8, 0, 0);
  EXPECT_NEAR(reference(Hinge(pairs[0], 90, random), 1).value(0, 0), 0.200043776075, 1e-12);
}

}  // namespace
}  // namespace interflect::fem
