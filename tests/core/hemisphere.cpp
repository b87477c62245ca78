#include "core/hemisphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"

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

// Of the density cos / pi: 1/4 of z is below 1/2, and x² and y² have the mean 1/4, z² 1/2.
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
  EXPECT_NEAR(low / n, .25, 5e-3);
  EXPECT_LT((squares - Vec3(.25, .25, .5)).cwiseAbs().maxCoeff(), 4e-3);
  EXPECT_LT((sum - Vec3(0, 0, 2. / 3)).cwiseAbs().maxCoeff(), 6e-3);
}

}  // namespace
}  // namespace interflect::core
