#include "core/hemisphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "tests/support/family.h"

namespace interflect::core {
namespace {

// Against long doubles; quarters and eighths, beside which another piece begins, are among them.
TEST(Hemisphere, sines_of_turns_are_within_what_they_state) {
  RandomNumbers random(1, 0, 0);
  const auto expect_near = [](double turns) {
    double sine = 0, cosine = 0;
    sin_cos_turns(turns, sine, cosine);
    const long double angle = 2 * std::numbers::pi_v<long double> * turns;
    ASSERT_NEAR(sine, static_cast<double>(std::sin(angle)), 2.5e-16) << turns;
    ASSERT_NEAR(cosine, static_cast<double>(std::cos(angle)), 2.5e-16) << turns;
  };
  for (int k = 0; k < 200'000; ++k) expect_near(random.next());
  for (int eighth = 0; eighth <= 8; ++eighth)
    for (const double beside : {-1e-16, 0.0, 1e-16}) expect_near(std::clamp(eighth / 8.0 + beside, 0.0, 1.0));
}

TEST(Hemisphere, many_directions_are_those_of_each) {
  RandomNumbers random(2, 0, 0);
  CosineHemisphere<64> many;
  for (Index k = 0; k < 64; ++k) many.u[k] = random.next(), many.v[k] = random.next();
  many.find();
  for (Index k = 0; k < 64; ++k) {
    const Vec3 one = cosine_hemisphere(many.u[k], many.v[k]);
    EXPECT_EQ(many[k], one);
    EXPECT_NEAR(one.norm(), 1, 1e-15);
    EXPECT_GT(one.z(), 0);
  }
}

TEST(Hemisphere, directions_go_there_and_back) {
  RandomNumbers random(4, 0, 0);
  for (int k = 0; k < 20'000; ++k) {
    const double u = random.next(), v = random.next();
    const Vec2 back = cosine_hemisphere_inverse(cosine_hemisphere(u, v));
    ASSERT_NEAR(back.x(), u, 1e-12);
    ASSERT_NEAR(back.y(), v, 1e-12);
  }
}

// Heron's area; and corners whose coordinates are as large as their distances from each other.
TEST(Hemisphere, points_of_a_triangle_go_there_and_back) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const Vec3 a = scale * Vec3(1, 2, 3), b = scale * Vec3(4, 2, 1), c = scale * Vec3(-1, 5, 2);
    const double p = (b - a).norm(), q = (c - b).norm(), r = (a - c).norm(), s = (p + q + r) / 2;
    EXPECT_NEAR(triangle_point_pdf_area(a, b, c) * std::sqrt(s * (s - p) * (s - q) * (s - r)), 1, 1e-14);
    RandomNumbers random(5, 0, 0);
    for (int k = 0; k < 20'000; ++k) {
      const double u = random.next(), v = random.next();
      const Vec2 back = triangle_point_inverse(a, b, c, triangle_point(a, b, c, u, v));
      ASSERT_NEAR(back.x(), u, 1e-12) << scale;
      ASSERT_NEAR(back.y(), v, 1e-12) << scale;
    }
    EXPECT_EQ(triangle_point_inverse(a, b, c, a), Vec2(0, 0));
  }
}

// Of the density cos / pi: 1/4 of z is below 1/2, and x² and y² have the mean 1/4 and the variance 1/16, z² 1/2 and
// 1/12; x and y 0 and 1/4, z 2/3 and 1/18.
TEST(Hemisphere, directions_have_the_moments_of_a_cosine) {
  RandomNumbers random(3, 0, 0);
  constexpr int n = 200'000;
  double low = 0;
  Vec3 squares = Vec3::Zero(), sum = Vec3::Zero();
  for (int k = 0; k < n; ++k) {
    const Vec3 d = cosine_hemisphere(random.next(), random.next());
    low += d.z() < .5;
    squares += d.cwiseAbs2() / n, sum += d / n;
  }
  test::Family family(2 * 7);
  const auto expect_mean = [&](double found, double mean, double variance) {
    EXPECT_NEAR(found, mean, family.z() * std::sqrt(variance / n));
  };
  expect_mean(low / n, .25, 3. / 16);
  for (const int axis : {0, 1}) expect_mean(squares[axis], .25, 1. / 16), expect_mean(sum[axis], 0, .25);
  expect_mean(squares.z(), .5, 1. / 12);
  expect_mean(sum.z(), 2. / 3, 1. / 18);
}

}  // namespace
}  // namespace interflect::core
