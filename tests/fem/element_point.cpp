#include "fem/element_point.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/random.h"

namespace interflect::fem {
namespace {

/// Quads that are no parallelograms, tilted: a trapezium, a kite, one without any symmetry; and triangles.
std::vector<scene::SurfacePatch> elements() {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.9, Vec3(2, 1, -1).normalized()).toRotationMatrix();
  const std::vector<std::vector<Vec3>> rings{{{0, 0, 1}, {4, 0, 1}, {3, 2, 1}, {1, 2, 1}},
                                             {{0, 0, 1}, {1, -0.5, 1}, {5, 0, 1}, {1, 0.5, 1}},
                                             {{0, 0, 1}, {3, 0.2, 1}, {2.5, 1.7, 1}, {-0.4, 0.9, 1}},
                                             {{0, 0, 1}, {2, 0, 1}, {0.3, 1.5, 1}}};
  std::vector<scene::SurfacePatch> patches;
  for (std::vector<Vec3> ring : rings) {
    for (Vec3& x : ring) x = turn * x;
    patches.push_back(scene::make_patch({0}, scene::Side::front, ring));
  }
  return patches;
}

// On a quad the weight is linear in (s, t) and the position bilinear, so that weight x position is of degree 2 in each:
// Simpson's rule (1, 4, 1)/6 is exact.
TEST(ElementMap, of_a_quad_has_weights_of_mean_1_and_the_centroid_as_weighted_mean_position) {
  const double at[3] = {0, 0.5, 1}, share[3] = {1 / 6.0, 4 / 6.0, 1 / 6.0};
  for (const scene::SurfacePatch& patch : elements()) {
    if (patch.corners == 3) continue;
    const ElementMap onto(patch);
    double weight = 0;
    Vec3 moment = Vec3::Zero();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const WeightedPoint p = onto(at[i], at[j]);
        EXPECT_GT(p.weight, 0);
        weight += share[i] * share[j] * p.weight;
        moment += share[i] * share[j] * p.weight * p.position;
      }
    EXPECT_NEAR(weight, 1, 1e-15);
    EXPECT_LE((moment - patch.centroid()).norm(), 4e-15);
  }
}

// The area that a small cell of the square is mapped to, over the cell's share of the element's: by the corners of the
// cell.
TEST(ElementMap, has_the_ratio_of_areas_as_its_weight) {
  core::RandomNumbers random(21, 0, 0);
  constexpr double h = 1e-3;
  for (const scene::SurfacePatch& patch : elements()) {
    const ElementMap onto(patch);
    for (int k = 0; k < 100; ++k) {
      const double s = 0.01 + 0.98 * random.next(), t = 0.01 + 0.98 * random.next();
      const std::array<Vec3, 4> cell{onto(s - h, t - h).position, onto(s + h, t - h).position,
                                     onto(s + h, t + h).position, onto(s - h, t + h).position};
      const double area = scene::make_patch({0}, scene::Side::front, cell).area;
      // The weight is linear in the cell of a quad; sqrt(s) of a triangle's map is curved by (h / s)^2 / 8.
      EXPECT_NEAR(area / (4 * h * h * patch.area), onto(s, t).weight,
                  patch.corners == 4 ? 1e-10 : 0.2 * h * h / (s * s));
    }
  }
}

TEST(ElementMap, gives_lanes_what_it_gives_one_by_one) {
  core::RandomNumbers random(22, 0, 0);
  for (const scene::SurfacePatch& patch : elements()) {
    const ElementMap onto(patch);
    PointLanes::Numbers s, t;
    for (std::size_t l = 0; l < PointLanes::count; ++l) s[l] = random.next(), t[l] = random.next();
    const PointLanes lanes = onto(s, t);
    for (std::size_t l = 0; l < PointLanes::count; ++l) {
      const WeightedPoint one = onto(s[l], t[l]);
      EXPECT_LE((lanes.position(l) - one.position).norm(), 2e-15);
      EXPECT_NEAR(lanes.weight[l], one.weight, 1e-15);
    }
  }
}

}  // namespace
}  // namespace interflect::fem
