#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "montecarlo/film/reconstruction_filter.h"
#include "tests/support/family.h"

namespace interflect::montecarlo {
namespace {

/// Midpoints in squares of 1/128 pixel, whose edges are where box and cubics have theirs.
double integral(const ReconstructionFilter& filter, const std::function<double(const Vec2&)>& f) {
  constexpr int per_pixel = 128;
  const int n = static_cast<int>(2 * std::ceil(filter.reach())) * per_pixel;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec2 at((i + 0.5) / per_pixel - n / (2.0 * per_pixel), (j + 0.5) / per_pixel - n / (2.0 * per_pixel));
      sum += f(at);
    }
  return sum / (per_pixel * per_pixel);
}

// The rule's error is h² / 24 times the jump of the slope, 1e-5 here; the Gaussian is cut at 3e-4 of its height.
TEST(ReconstructionFilter, integrates_to_one) {
  for (const std::string& name : filter_names()) {
    const auto filter = make_filter(name);
    EXPECT_NEAR(integral(*filter, [&](const Vec2& u) { return filter->value(u); }), 1, 2e-5) << name;
    EXPECT_NEAR(integral(*filter, [&](const Vec2& u) { return std::max(0.0, -filter->value(u)); }), filter->negative(),
                2e-5)
        << name;
    const double r = filter->reach();
    for (const Vec2& beyond : {Vec2(r + 1e-9, 0), Vec2(0, -r - 1e-9), Vec2(-r - 1e-9, r / 2)})
      EXPECT_EQ(filter->value(beyond), 0) << name;
  }
}

// Pixels' filters side by side are 1 everywhere, where that is so by design: light falls into the picture as it is.
TEST(ReconstructionFilter, shares_light_out_among_pixels) {
  for (const auto& [name, off] :
       {std::pair{"box", 0.0}, {"triangle", 1e-15}, {"gaussian", 0.04}, {"mitchell", 1e-14}}) {
    const auto filter = make_filter(name);
    core::RandomNumbers numbers(3, 0, 0);
    for (int k = 0; k < 100; ++k) {
      const double x = numbers.next();
      const Vec2 at(x, numbers.next());
      double sum = 0;
      for (int i = -3; i <= 3; ++i)
        for (int j = -3; j <= 3; ++j) sum += filter->value(at - Vec2(i + 0.5, j + 0.5));
      EXPECT_NEAR(sum, 1, off) << name;
    }
  }
}

/// Offsets fall into the cells of a grid as often as a density says (chi-squared).
void expect_density(const std::string& name, double reach, const std::function<double(const Vec2&)>& density,
                    const std::function<Vec2(double, double)>& sample, test::Family& family) {
  constexpr int cells = 16, samples = 200'000, fine = 32;
  const double cell = 2 * reach / cells;
  std::vector<double> expected(cells * cells), found(cells * cells);
  for (int i = 0; i < cells * fine; ++i)
    for (int j = 0; j < cells * fine; ++j)
      expected[static_cast<std::size_t>(i / fine * cells + j / fine)] +=
          density({(i + 0.5) * cell / fine - reach, (j + 0.5) * cell / fine - reach}) * cell * cell / (fine * fine) *
          samples;
  for (std::uint64_t k = 0; k < samples; ++k) {
    core::RandomNumbers numbers(4, 0, k);
    const double u = numbers.next();
    const Vec2 offset = sample(u, numbers.next());
    ASSERT_LE(offset.cwiseAbs().maxCoeff(), reach) << name;
    ASSERT_GT(density(offset), 0) << name << ' ' << offset.transpose();
    const auto at = [&](double x) { return std::min(cells - 1, static_cast<int>((x + reach) / cell)); };
    found[static_cast<std::size_t>(at(offset.x()) * cells + at(offset.y()))] += 1;
  }
  double chi2 = 0, few = 0, few_found = 0;
  int degrees = -1;
  const auto count = [&](double n, double of) {
    chi2 += (n - of) * (n - of) / of;
    ++degrees;
  };
  for (std::size_t k = 0; k < expected.size(); ++k)
    if (expected[k] > 10) {
      count(found[k], expected[k]);
    } else {
      few += expected[k];
      few_found += found[k];
    }
  if (few > 10) count(few_found, few);
  // Wilson and Hilferty: the cube root of chi² / d is normal, of variance 2 / (9 d).
  const double z = (std::cbrt(chi2 / degrees) - (1 - 2.0 / (9 * degrees))) / std::sqrt(2.0 / (9 * degrees));
  EXPECT_LT(std::abs(z), family.z()) << name << ' ' << chi2 << " of " << degrees;
}

TEST(ReconstructionFilter, draws_its_positive_and_its_negative_part) {
  std::size_t drawn = 0;
  for (const std::string& name : filter_names()) drawn += make_filter(name)->negative() > 0 ? 2 : 1;
  test::Family family(2 * drawn);
  for (const std::string& name : filter_names()) {
    const auto filter = make_filter(name);
    const double negative = filter->negative();
    expect_density(
        name, filter->reach(), [&](const Vec2& at) { return std::max(0.0, filter->value(at)) / (1 + negative); },
        [&](double u, double v) { return filter->sample(u, v); }, family);
    if (negative == 0) continue;
    expect_density(
        name, filter->reach(), [&](const Vec2& at) { return std::max(0.0, -filter->value(at)) / negative; },
        [&](double u, double v) { return filter->sample_negative(u, v); }, family);
  }
}

TEST(ReconstructionFilter, goes_from_numbers_to_offsets_and_back) {
  for (const std::string& name : filter_names()) {
    const auto filter = make_filter(name);
    for (std::uint64_t k = 0; k < 20'000; ++k) {
      core::RandomNumbers numbers(5, 0, k);
      const double u = numbers.next(), v = numbers.next();
      ASSERT_LT((filter->inverse(filter->sample(u, v)) - Vec2(u, v)).cwiseAbs().maxCoeff(), 1e-12) << name;
      if (filter->negative() == 0) continue;
      ASSERT_LT((filter->inverse_negative(filter->sample_negative(u, v)) - Vec2(u, v)).cwiseAbs().maxCoeff(), 1e-12)
          << name;
    }
  }
}

TEST(ReconstructionFilter, is_drawn_at_the_ends_of_the_numbers_too) {
  constexpr double last = 1 - 0x1p-53;
  for (const std::string& name : filter_names()) {
    const auto filter = make_filter(name);
    for (const double u : {0.0, 0x1p-53, 0.5, last})
      for (const double v : {0.0, 0.5, last}) {
        std::vector<Vec2> offsets{filter->sample(u, v)};
        if (filter->negative() > 0) offsets.push_back(filter->sample_negative(u, v));
        for (const Vec2& offset : offsets) {
          EXPECT_TRUE(offset.allFinite()) << name << ' ' << u << ' ' << v;
          EXPECT_LE(offset.cwiseAbs().maxCoeff(), filter->reach()) << name;
        }
      }
  }
}

TEST(ReconstructionFilter, is_known_by_name) {
  EXPECT_THROW(make_filter("lanczos"), core::InputError);
  EXPECT_EQ(filter_names().size(), 4u);
}

}  // namespace
}  // namespace interflect::montecarlo
