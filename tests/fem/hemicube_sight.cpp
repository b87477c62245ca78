#include "fem/form_factor/hemicube_sight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "fem/form_factor/hemicube.h"
#include "fem/form_factor/max_cells.h"
#include "fem/form_factor/point_to_polygon.h"
#include "tests/fem/aliasing.h"

// What a hemicube's cells weigh and what they show: of one point, without a scene.
namespace interflect::fem {
namespace {

using fem::test::aliasing;
using geometry::Ring;

constexpr double top_fraction = 0.5541264239795719, side_fraction = 0.1114683940051071;

TEST(HemicubeGrid, exact_cells_sum_to_one_at_any_resolution) {
  for (const int resolution : {2, 16, 32, 50, 256, 512})
    for (const HemicubeGrid& grid :
         {HemicubeGrid::uniform(resolution), HemicubeGrid::equal_factor(resolution), max_cells(resolution)}) {
      EXPECT_NEAR(grid.sum(), 1, 1e-14) << resolution;
      EXPECT_EQ(grid.cells(), 3 * resolution * resolution);
      for (const double weight : grid.top.weight) ASSERT_GT(weight, 0);
      for (const double weight : grid.side.weight) ASSERT_GT(weight, 0);
    }
}

TEST(HemicubeGrid, faces_have_their_known_parts_of_the_hemisphere) {
  EXPECT_NEAR(4 * factor_across(1, 1), top_fraction, 1e-15);
  EXPECT_NEAR(2 * factor_beside(1, 1), side_fraction, 1e-15);
  EXPECT_NEAR(HemicubeGrid::uniform(64).top.sum(), top_fraction, 1e-14);
  EXPECT_NEAR(HemicubeGrid::uniform(64).side.sum(), side_fraction, 1e-14);
}

TEST(HemicubeGrid, the_largest_cell_is_4_over_pi_n_squared) {
  const FaceGrid grid = HemicubeGrid::uniform(256, CellWeights::midpoint).top;
  EXPECT_NEAR(*std::max_element(grid.weight.begin(), grid.weight.end()) * 256 * 256 * pi / 4, 1, 1e-4);
}

// Computed independently, to the four digits printed.
TEST(HemicubeGrid, midpoint_weights_miss_one_by_the_known_amounts) {
  for (const auto& [resolution, error] : std::map<int, double>{
           {16, 2.123e-3}, {32, 5.296e-4}, {64, 1.323e-4}, {128, 3.308e-5}, {256, 8.270e-6}, {512, 2.067e-6}}) {
    const double half_a_digit = 0.5005e-3 * std::pow(10, std::floor(std::log10(error)));
    EXPECT_NEAR(std::abs(HemicubeGrid::uniform(resolution, CellWeights::midpoint).sum() - 1), error, half_a_digit)
        << resolution;
  }
}

TEST(HemicubeGrid, an_odd_resolution_is_refused_by_the_grid_and_rounded_up_by_the_method) {
  EXPECT_THROW(HemicubeGrid::uniform(15), core::PreconditionError);
  EXPECT_THROW(max_cells(0), core::PreconditionError);
  EXPECT_EQ(even_resolution(15), 16);
  EXPECT_EQ(even_resolution(-3), 2);
}

/// A triangle about the eye, in its local coordinates, of any orientation.
Ring random_triangle(core::RandomNumbers& u) {
  const auto ball = [&u] {
    for (;;) {
      const double x = u.next(), y = u.next(), z = u.next();
      if (Vec3 p = 2 * Vec3(x, y, z) - Vec3::Ones(); p.norm() < 1) return p;
    }
  };
  const Vec3 centre = ball().normalized(), a = centre + 0.6 * ball(), b = centre + 0.6 * ball(),
             c = centre + 0.6 * ball();
  return {a, b, c};
}
double exact_factor(const Ring& ring) { return point_to_polygon(Vec3::Zero(), Vec3::UnitZ(), ring); }
double seen_factor(HemicubeSight& sight, const Ring& ring) { return sight.add(ring, geometry::plane_of(ring), 0); }
double edge_length(const Ring& ring) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += std::acos(std::clamp(ring[k].normalized().dot(ring[(k + 1) % 3].normalized()), -1.0, 1.0));
  return sum;
}

double sky(const HemicubeSight& sight) {
  double sum = 0;
  for (std::size_t face = 0; face < HemicubeSight::faces; ++face) {
    const FaceGrid& grid = sight.buffer(face).grid();
    for (int j = 0; j < grid.y.cells(); ++j)
      for (int i = 0; i < grid.x.cells(); ++i)
        if (sight.buffer(face).item(i, j) == ItemBuffer::sky) sum += grid.weight_at(i, j);
  }
  return sum;
}

TEST(HemicubeSight, all_items_and_the_sky_sum_to_one) {
  for (const HemicubeGrid& grid : {HemicubeGrid::uniform(64), max_cells(64)}) {
    HemicubeSight sight(grid);
    core::RandomNumbers u(1, 0, 0);
    SeenItems seen;
    seen.clear(20);
    for (std::int32_t k = 0; k < 20; ++k) {
      const Ring ring = random_triangle(u);
      seen.covered[static_cast<std::size_t>(k)] = sight.add(ring, geometry::plane_of(ring), k);
    }
    sight.count(seen);
    double sum = sky(sight);
    EXPECT_GT(sum, 0.01);
    for (std::size_t k = 0; k < 20; ++k) {
      EXPECT_LE(seen.visible[k], seen.covered[k] + 1e-15);
      sum += seen.visible[k];
    }
    EXPECT_NEAR(sum, 1, 1e-13);
  }
}

// Turned about the zenith an item's factor varies by aliasing alone: with the variance that `border` states, border /
// 17.
TEST(HemicubeSight, turned_about_the_zenith_varies_as_its_border_cells_say) {
  for (const HemicubeGrid& grid : {HemicubeGrid::uniform(64), max_cells(64)}) {
    HemicubeSight sight(grid);
    double ratios = 0, largest = 0;
    constexpr int triangles = 200, turns = 50;
    int counted = 0;
    for (int t = 0; t < triangles; ++t) {
      core::RandomNumbers u(2, 0, static_cast<std::uint64_t>(t));
      const Ring ring = random_triangle(u);
      const double exact = exact_factor(ring);
      if (exact < 0.01) continue;
      double squares = 0, stated = 0;
      for (int k = 0; k < turns; ++k) {
        const Eigen::AngleAxisd turn(2 * pi * u.next(), Vec3::UnitZ());
        Ring turned;
        for (const Vec3& corner : ring) turned.push_back(turn * corner);
        SeenItems seen;
        seen.clear(1);
        sight.clear();
        seen_factor(sight, turned);
        sight.count(seen);
        squares += std::pow(seen.visible[0] - exact, 2) / turns;
        stated += seen.border[0] / 17 / turns;
      }
      ratios += squares / stated;
      largest = std::max(largest, squares / stated);
      ++counted;
    }
    EXPECT_GT(counted, 30);
    EXPECT_NEAR(ratios / counted, 1, 0.3);
    EXPECT_LT(largest, 8);  // of triangles thinner than a cell, which are seen or missed as a whole
  }
}

/// Errors of random triangles' factors.
std::vector<double> errors(const HemicubeGrid& grid, int triangles, std::uint32_t stream = 0) {
  HemicubeSight sight(grid);
  std::vector<double> found;
  for (int t = 0; t < triangles; ++t) {
    core::RandomNumbers u(3, stream, static_cast<std::uint64_t>(t));
    const Ring ring = random_triangle(u);
    found.push_back(seen_factor(sight, ring) - exact_factor(ring));
  }
  return found;
}
double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// Random edges: N^-1.5.
TEST(HemicubeSight, errors_of_random_triangles_fall_as_cells_to_the_power_of_three_quarters) {
  const double coarse = root_mean_square(errors(HemicubeGrid::uniform(16), 3000)),
               fine = root_mean_square(errors(HemicubeGrid::uniform(256), 3000));
  EXPECT_NEAR(std::log(coarse / fine) / std::log(16), 1.5, 0.1);
}

// The derivation in max_cells.h has no free constant; half of the edges lie above the horizon.
TEST(MaxCells, expected_errors_are_those_of_random_triangles) {
  double edges = 0;
  constexpr int triangles = 10'000;
  for (int t = 0; t < triangles; ++t) {
    core::RandomNumbers u(3, 0, static_cast<std::uint64_t>(t));
    edges += 0.5 * edge_length(random_triangle(u)) / triangles;
  }
  for (const HemicubeGrid& grid : {HemicubeGrid::uniform(32), HemicubeGrid::equal_factor(32), max_cells(32)})
    EXPECT_NEAR(root_mean_square(errors(grid, triangles)) / aliasing(grid, edges), 1, 0.12);
}

TEST(MaxCells, lie_where_the_expected_error_is_least) {
  for (const int resolution : {32, 64, 128}) {
    const double uniform = edge_error(HemicubeGrid::uniform(resolution)),
                 equal = edge_error(HemicubeGrid::equal_factor(resolution)), best = edge_error(max_cells(resolution));
    EXPECT_NEAR(equal / uniform, 0.735, 0.002) << resolution;
    EXPECT_NEAR(best / uniform, 0.559, 0.002) << resolution;
  }
  // No step of a top's boundaries, kept symmetric, does better by more than the flatness of the optimum.
  const HemicubeGrid grid = max_cells(32);
  for (std::size_t k = 1; k < 16; ++k)
    for (const double step : {-0.03, 0.03}) {
      std::vector<double> boundaries = grid.top.x.boundaries();
      const double move = step * (boundaries[k + 1] - boundaries[k]);
      boundaries[k] += move;
      boundaries[32 - k] -= move;
      const CellAxis moved(boundaries, grid.top.x.samples());
      EXPECT_GT(edge_error(HemicubeGrid::of(grid.height, moved, moved, grid.side.x, grid.side.y)),
                edge_error(grid) * (1 - 1e-4))
          << k;
    }
}

struct Interval {
  double low, high;
};
/// Of the root mean square, 95 %, by 1 000 resamples; of what `statistic` makes of a resample.
template <class Statistic>
Interval bootstrap(std::size_t n, const Statistic& statistic) {
  std::vector<double> found;
  std::vector<std::size_t> sample(n);
  for (std::uint64_t k = 0; k < 1000; ++k) {
    core::RandomNumbers u(4, 0, k);
    for (std::size_t& index : sample) index = static_cast<std::size_t>(u.next() * static_cast<double>(n));
    found.push_back(statistic(sample));
  }
  std::sort(found.begin(), found.end());
  return {found[25], found[974]};
}

TEST(MaxCells, err_less_than_cells_of_equal_factor_which_err_less_than_equal_cells) {
  constexpr int triangles = 10'000;
  std::vector<Interval> rms;
  for (const HemicubeGrid& grid : {max_cells(32), HemicubeGrid::equal_factor(32), HemicubeGrid::uniform(32)}) {
    const std::vector<double> found = errors(grid, triangles, 1);
    rms.push_back(bootstrap(found.size(), [&](const std::vector<std::size_t>& sample) {
      double sum = 0;
      for (const std::size_t k : sample) sum += found[k] * found[k];
      return std::sqrt(sum / static_cast<double>(sample.size()));
    }));
  }
  EXPECT_LT(rms[0].high, rms[1].low);
  EXPECT_LT(rms[1].high, rms[2].low);
}

}  // namespace
}  // namespace interflect::fem
