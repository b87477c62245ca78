#include "photometry/sensor_summary.h"

#include <gtest/gtest.h>

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
}

}  // namespace
}  // namespace interflect::photometry
