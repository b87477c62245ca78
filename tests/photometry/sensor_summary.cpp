#include "photometry/sensor_summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace interflect::photometry {
namespace {

Estimate estimate(double value, double bound, double noise) {
  return {Spectrum(value), Spectrum(noise), Spectrum(bound), Claim::estimated, 1};
}

TEST(SensorSummary, statistics_are_those_of_the_weighted_values) {
  scene::Scene scene;
  scene.channels = {"y"};
  scene.weights[0] = 2;
  const measure::PointIrradiance nowhere{Vec3::Zero(), Vec3::UnitZ(), {}};
  const std::vector<measure::SensorPoint> points{
      {"desk", 0, nowhere}, {"wall", 0, nowhere}, {"desk", 1, nowhere}, {"desk", 2, nowhere}};
  const std::vector<Estimate> values{estimate(10, 1, 0.3), estimate(7, 0, 0), estimate(30, 2, 0.4), estimate(20, 3, 0)};
  const auto summaries = summarise(scene, points, values);
  ASSERT_EQ(summaries.size(), 2u);
  const SensorSummary& desk = summaries[0];
  EXPECT_EQ(desk.sensor, "desk");
  EXPECT_EQ(desk.points, 3);
  EXPECT_DOUBLE_EQ(desk.minimum, 20);
  EXPECT_DOUBLE_EQ(desk.mean, 40);
  EXPECT_DOUBLE_EQ(desk.maximum, 60);
  EXPECT_DOUBLE_EQ(desk.uniformity(), 0.5);
  EXPECT_NEAR(desk.error, 2 * (6 + normal_95 * 0.5) / 3, 1e-12);  // noise: sqrt(0.3² + 0.4²) = 0.5
  EXPECT_DOUBLE_EQ(summaries[1].mean, 14);
  EXPECT_NEAR(desk.minimum_error, 2 * (1 + normal_95 * 0.3), 1e-12);
  EXPECT_NEAR(desk.maximum_error, 2 * (2 + normal_95 * 0.4), 1e-12);
  const double low = (20 - desk.minimum_error) / (40 + desk.error),
               high = (20 + desk.minimum_error) / (40 - desk.error);
  EXPECT_NEAR(desk.uniformity_error(), std::max(.5 - low, high - .5), 1e-12);
}

// The point that looks darkest need not be: another, less well known, may be darker.
TEST(SensorSummary, the_least_is_known_by_all_points) {
  scene::Scene scene;
  scene.channels = {"y"};
  scene.weights[0] = 1;
  const measure::PointIrradiance nowhere{Vec3::Zero(), Vec3::UnitZ(), {}};
  const std::vector<measure::SensorPoint> points{{"desk", 0, nowhere}, {"desk", 1, nowhere}};
  const SensorSummary desk =
      summarise(scene, points, std::vector<Estimate>{estimate(10, 1, 0), estimate(12, 7, 0)}).front();
  EXPECT_DOUBLE_EQ(desk.minimum, 10);
  EXPECT_DOUBLE_EQ(desk.minimum_error, 5);  // 12 - 7
  EXPECT_DOUBLE_EQ(desk.maximum_error, 7);  // 12 + 7
  const SensorSummary dark =
      summarise(scene, points, std::vector<Estimate>{estimate(1, 2, 0), estimate(1, 2, 0)}).front();
  EXPECT_TRUE(std::isinf(dark.uniformity_error()));
}

}  // namespace
}  // namespace interflect::photometry
