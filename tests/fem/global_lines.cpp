#include "fem/form_factor/global_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/fem/monte_carlo.h"

namespace interflect::fem {
namespace {

using test::Room;
using test::Sampled;

constexpr std::uint64_t lines = 400'000;

Room cube(int n) {
  Room room;
  room.box({0, 0, 0}, {1, 1, 1}, n);
  return room;
}

template <class Visit>
void for_lines(const GlobalLines& method, const Visit& visit) {
  std::vector<scene::SurfacePoint> hits;
  std::vector<LinesThrough::Exchange> pairs;
  for (std::uint64_t k = 0; k < lines; ++k) {
    const raycast::Ray line = method.line(k);
    method.through().pairs_along(line, hits, pairs);
    visit(line, hits, pairs);
  }
}

// Binomial counts, 25 two-sided comparisons at 4.5 standard deviations: alpha 2e-4.
TEST(GlobalLines, meet_a_patch_with_probability_A_over_2_pi_R2_and_a_convex_body_with_S_over_4_pi_R2) {
  const Sampled sampled(cube(2));
  const GlobalLines method(sampled.context(lines));
  EXPECT_NEAR(method.through().radius(), std::sqrt(0.75), 1e-12);
  std::vector<double> met(24, 0);
  double body = 0;
  for_lines(method, [&](const raycast::Ray&, const auto& hits, const auto& pairs) {
    body += !hits.empty();
    for (const LinesThrough::Exchange& pair : pairs)
      ++met[static_cast<std::size_t>(pair.from)], ++met[static_cast<std::size_t>(pair.to)];
  });
  const auto expect = [&](double count, double p) {
    EXPECT_NEAR(count, lines * p, 4.5 * std::sqrt(lines * p * (1 - p)));
  };
  for (const double count : met) expect(count, 0.25 / (2 * pi * 0.75));
  expect(body, 0.6366197723675815);  // 6 / (4 pi R²)
}

// In a convex room a line makes one pair or none: chi-squared of a multinomial with p = K / (2 pi R²), alpha 3e-6 each
// side.
TEST(GlobalLines, join_pairs_in_proportion_to_their_exchange) {
  const Sampled sampled(cube(2));
  const GlobalLines method(sampled.context(lines));
  const test::Assembled exact = sampled.by("analytic", 0, 1, 1e-9);
  Eigen::MatrixXd found = Eigen::MatrixXd::Zero(24, 24);
  double none = 0;
  for_lines(method, [&](const raycast::Ray&, const auto&, const auto& pairs) {
    ASSERT_LE(pairs.size(), 1u);
    none += pairs.empty();
    for (const LinesThrough::Exchange& pair : pairs)
      ++found(std::max(pair.from, pair.to), std::min(pair.from, pair.to));
  });
  double chi_squared = 0, categories = 1, rest = lines;
  for (Index i = 0; i < 24; ++i)
    for (Index j = 0; j < i; ++j) {
      const double expected = lines * exact.K(i, j) / (2 * pi * 0.75);
      if (expected == 0) {
        EXPECT_EQ(found(i, j), 0);
        continue;
      }
      rest -= expected;
      ++categories;
      chi_squared += std::pow(found(i, j) - expected, 2) / expected;
    }
  chi_squared += std::pow(none - rest, 2) / rest;
  EXPECT_GT(categories, 200);
  EXPECT_LT(chi_squared, test::chi_squared_quantile(categories - 1, 4.5));
  EXPECT_GT(chi_squared, test::chi_squared_quantile(categories - 1, -4.5));
}

/// sqrt(n) times the largest distance of the distribution of numbers from the uniform one.
double kolmogorov_smirnov(std::vector<double> numbers) {
  std::sort(numbers.begin(), numbers.end());
  const auto n = static_cast<double>(numbers.size());
  double distance = 0;
  for (std::size_t k = 0; k < numbers.size(); ++k)
    distance =
        std::max({distance, numbers[k] - static_cast<double>(k) / n, static_cast<double>(k + 1) / n - numbers[k]});
  return std::sqrt(n) * distance;
}

// Given that a line meets a patch, cos² of its angle is uniform, and so are its place and its azimuth: beyond 2.3 with
// probability 5e-5 each.
TEST(GlobalLines, meet_a_patch_at_cosine_distributed_angles_in_uniform_places) {
  const Sampled sampled(cube(1));
  const GlobalLines method(sampled.context(lines));
  std::vector<double> angle, azimuth, x, y;
  for_lines(method, [&](const raycast::Ray& line, const auto& hits, const auto&) {
    for (const scene::SurfacePoint& hit : hits)
      if (hit.position.z() < 1e-6) {  // the floor
        angle.push_back(line.direction.z() * line.direction.z());
        azimuth.push_back(0.5 + std::atan2(line.direction.y(), line.direction.x()) / (2 * pi));
        x.push_back(hit.position.x());
        y.push_back(hit.position.y());
      }
  });
  EXPECT_GT(angle.size(), 80'000u);
  for (const auto& numbers : {angle, azimuth, x, y}) EXPECT_LT(kolmogorov_smirnov(numbers), 2.3);
}

// What stands on a floor touches it: no exchange through the nothing between them, and none through the body.
TEST(GlobalLines, exchange_nothing_between_surfaces_that_touch) {
  Room room;
  room.box({0, 0, 0}, {3, 3, 3}, 1);
  room.box({1, 1, 0}, {1, 1, 1}, 1, false);
  for (const std::string caster : {"embree", "brute"}) {
    const Sampled sampled(room, caster);
    const test::Assembled found = sampled.by("global-lines", 100'000);
    const test::Assembled exact = sampled.by("analytic", 0, 1, 1e-5);
    for (Index i = 0; i < 12; ++i)
      for (Index j = 0; j < i; ++j)
        if (exact.K(i, j) == 0) {
          EXPECT_EQ(found.K(i, j), 0) << caster << i << ' ' << j;
        } else {
          EXPECT_NEAR(found.K(i, j), exact.K(i, j), 5 * found.error(i, j)) << caster << i << ' ' << j;
        }
  }
}

TEST(GlobalLines, tell_beforehand_how_long_they_take) {
  const Sampled sampled(test::room_with_boxes(3));
  const GlobalLines few(sampled.context(100'000)), many(sampled.context(100'000'000));
  core::LocalRun run(1, 1);
  EXPECT_GT(few.trial(run.get()), 0);
  EXPECT_GT(many.trial(run.get()), few.trial(run.get()));  // 1 000 times the lines: no noise of a clock hides that
}

TEST(GlobalLines, of_one_element_or_none_are_nothing) {
  Room room;
  room.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);
  const Sampled sampled(room);
  EXPECT_EQ(sampled.by("global-lines", 1000).K(0, 0), 0);
}

}  // namespace
}  // namespace interflect::fem
