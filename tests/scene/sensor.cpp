#include "scene/sensor.h"

#include <gtest/gtest.h>

#include <limits>

namespace interflect::scene {
namespace {

using Counts = std::array<std::int64_t, 2>;

SensorGrid grid(double u, double v, const std::variant<double, Eigen::Array2i>& step, double border = 0) {
  return {Vec3::Zero(), Vec3(u, 0, 0), Vec3(0, v, 0), step, border};
}

TEST(SensorGrid, cells_are_as_given_or_length_over_spacing_rounded) {
  EXPECT_EQ(cell_counts(grid(6, 4, Eigen::Array2i(3, 2))), (Counts{3, 2}));
  EXPECT_EQ(cell_counts(grid(6, 4, 1.6)), (Counts{4, 3}));       // 3.75, 2.5
  EXPECT_EQ(cell_counts(grid(6, 4, 1.6, 0.4)), (Counts{3, 2}));  // 5.2 / 1.6 = 3.25, 3.2 / 1.6 = 2
  EXPECT_EQ(cell_counts(grid(6, 1e-9, 1.0)), (Counts{6, 1}));    // a side shorter than half a spacing has one
}

TEST(SensorGrid, counts_beyond_every_use_are_numbers_still) {
  constexpr std::int64_t most = 1'000'000'000;
  EXPECT_EQ(cell_counts(grid(1e12, 1e300, 1e-6)), (Counts{most, most}));
  EXPECT_EQ(cell_counts(grid(1e6, 1e6, std::numeric_limits<double>::quiet_NaN())),
            (Counts{100'000, 100'000}));  // p <= 10 m
}

}  // namespace
}  // namespace interflect::scene
