#include <gtest/gtest.h>

#include <cmath>

#include "fem/form_factor/element_clusters.h"
#include "fem/form_factor/pair_integral.h"
#include "scene/place.h"

namespace interflect::fem {
namespace {

/// The walls of a box of 20 x 6 x 3 m, elements of about `size`, turned so that no wall is parallel to an axis, and
/// shifted: a building in coordinates of a national grid, whose corners are 9.3e-10 m apart.
std::vector<scene::SurfacePatch> room_in_grid_coordinates(double size) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.6, Vec3(1, -2, 3).normalized()).toRotationMatrix();
  const Vec3 shift(5e5, 5e6, 0), extent(20, 6, 3);
  std::vector<scene::SurfacePatch> patches;
  for (std::uint32_t side = 0; side < 6; ++side) {
    const int axis = static_cast<int>(side / 2), first = (axis + 1) % 3, second = (axis + 2) % 3;
    const Index nu = std::lround(extent[first] / size), nv = std::lround(extent[second] / size);
    const auto at = [&](Index i, Index j) -> Vec3 {
      Vec3 x = Vec3::Zero();
      x[axis] = side % 2 == 0 ? 0.0 : extent[axis];
      x[first] = extent[first] * static_cast<double>(i) / static_cast<double>(nu);
      x[second] = extent[second] * static_cast<double>(j) / static_cast<double>(nv);
      return shift + turn * x;
    };
    for (Index i = 0; i < nu; ++i)
      for (Index j = 0; j < nv; ++j) {
        std::array<Vec3, 4> ring{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
        if (side % 2 == 1) std::swap(ring[1], ring[3]);  // seen from inside
        patches.push_back(scene::make_patch({side}, scene::Side::front, ring));
      }
  }
  return patches;
}

// An element of 0.2 m is tilted by 9.3e-10 / 0.2: 20 m away its plane is 1e-7 m off.
TEST(FarFromOrigin, elements_of_one_wall_exchange_nothing) {
  const auto patches = room_in_grid_coordinates(0.25);
  const PairIntegrator integrate(patches, 1e-3);
  int seen = 0;
  for (Index i = 0; i < Index(patches.size()); ++i)
    for (Index j = i % 7; j < i; j += 7)
      if (patches[std::size_t(i)].surface == patches[std::size_t(j)].surface)
        seen += integrate(i, j).facing != Facing::away;
  EXPECT_EQ(seen, 0);
}

TEST(FarFromOrigin, clusters_of_a_wall_keep_their_rectangle) {
  const auto patches = room_in_grid_coordinates(0.25);
  const ElementShapes shapes(patches);
  const auto clusters = clusters_of(patches, shapes);
  for (const ElementCluster& cluster : clusters) EXPECT_TRUE(cluster.rectangle.has_value());
  EXPECT_LT(clusters.size(), patches.size() / 15) << "of up to 32 elements each";
}

// What is proved away is away: nothing is missing from the row sums of a closed room.
TEST(FarFromOrigin, form_factors_of_a_closed_room_sum_to_one) {
  const auto patches = room_in_grid_coordinates(0.5);
  const PairIntegrator integrate(patches, 1e-5);
  std::vector<double> sum(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double K = integrate(Index(i), Index(j)).value;
      sum[i] += K / patches[i].area;
      sum[j] += K / patches[j].area;
    }
  for (const double row : sum) EXPECT_NEAR(row, 1, 1e-5);
}

}  // namespace
}  // namespace interflect::fem
