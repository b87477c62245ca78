#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "fem/form_factor/element_clusters.h"
#include "fem/form_factor/pair_integral.h"
#include "scene/place.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

/// Where a building stands in coordinates of a national grid: its y are 9.3e-10 m apart.
const Vec3 grid_coordinates(5e5, 5e6, 0);

/// The walls of a corridor of 20 x 1 x 0.5 m, elements of about `size`, turned so that every wall stands slantwise to
/// the y axis, and shifted.
std::vector<scene::SurfacePatch> turned_corridor(double size, const Vec3& shift) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.0, Vec3(3, 1, 2).normalized()).toRotationMatrix();
  const Vec3 extent(20, 1, 0.5);
  std::vector<scene::SurfacePatch> patches;
  for (std::uint32_t side = 0; side < 6; ++side) {
    const int axis = static_cast<int>(side / 2), first = (axis + 1) % 3, second = (axis + 2) % 3;
    const Index nu = std::max(1L, std::lround(extent[first] / size)),
                nv = std::max(1L, std::lround(extent[second] / size));
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

// An element of 0.1 m is tilted by the rounding of its corners over 0.1 m, some 5e-9: 20 m away its plane is 1e-7 m
// off.
TEST(FarFromOrigin, elements_of_one_wall_exchange_nothing) {
  const auto patches = turned_corridor(0.1, grid_coordinates);
  const PairIntegrator integrate(patches, 1e-3);
  int pairs = 0, seen = 0;
  for (Index i = 0; i < Index(patches.size()); ++i)
    for (Index j = i % 7; j < i; j += 7) {
      if (patches[std::size_t(i)].surface != patches[std::size_t(j)].surface) continue;
      ++pairs;
      seen += integrate(i, j).facing != Facing::away;
    }
  EXPECT_EQ(seen, 0) << "of " << pairs;
}

// A wall is one plane, however its elements happen to be tilted.
TEST(FarFromOrigin, clusters_are_those_of_the_same_room_at_the_origin_and_keep_their_rectangle) {
  const auto far = turned_corridor(0.1, grid_coordinates), near = turned_corridor(0.1, Vec3::Zero());
  const auto clusters = clusters_of(far, ElementShapes(far)), same = clusters_of(near, ElementShapes(near));
  ASSERT_EQ(clusters.size(), same.size());
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    EXPECT_EQ(clusters[k].elements, same[k].elements);
    EXPECT_TRUE(clusters[k].rectangle.has_value());
  }
}

// What is proved away is away: nothing is missing from the row sums of a closed room.
TEST(FarFromOrigin, form_factors_of_a_closed_room_sum_to_one) {
  const auto patches = turned_corridor(0.5, grid_coordinates);
  for (const double row : test::unoccluded_row_sums(patches, 1e-5)) EXPECT_NEAR(row, 1, 1e-5);
}

// The walls that meet at an edge are rounded differently from the elements that do: neither blocks anything.
TEST(FarFromOrigin, a_convex_room_is_proved_clear_without_a_ray) {
  scene::SceneBuilder builder({"y"});
  const auto grey = builder.add_material(test::diffuse(0.5));
  for (const auto& wall : turned_corridor(100, grid_coordinates))
    builder.add_polygon("wall", {{wall.corner.begin(), wall.corner.end()}, {}}, grey);
  const auto patches = turned_corridor(0.5, grid_coordinates);
  const auto found = test::form_factors(builder.finish(), patches, 1e-3);
  EXPECT_GT(found.pairs.clear, 1000u);
  EXPECT_EQ(found.pairs.sampled, 0u);
}

// Its centroid would not be a number, and clusters are sorted by centroids.
TEST(FarFromOrigin, an_element_whose_area_is_lost_to_rounding_is_refused) {
  const std::array<Vec3, 3> line{Vec3(5e6, 0, 0), Vec3(5e6 + 1, 0, 0), Vec3(5e6 + 2, 0, 0)};
  const std::vector patches{scene::make_patch({0}, scene::Side::front, line)};
  EXPECT_THROW(ElementShapes{patches}, core::PreconditionError);
}

}  // namespace
}  // namespace interflect::fem
