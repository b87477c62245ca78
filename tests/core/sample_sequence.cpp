#include "core/sample_sequence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/moments.h"

namespace interflect::core {
namespace {

class EverySequence : public testing::TestWithParam<std::string> {};

// Points are uniform in each dimension and each two of them: moments within five standard errors.
TEST_P(EverySequence, is_uniform) {
  const auto sequence = make_sequence(GetParam(), 3);
  constexpr std::size_t dimensions = 9;
  constexpr std::uint64_t n = 1 << 14;
  double means[dimensions] = {}, products[dimensions][dimensions] = {};
  for (std::uint64_t k = 0; k < n; ++k) {
    double u[dimensions];
    sequence->point(k, u);
    for (std::size_t a = 0; a < dimensions; ++a) {
      ASSERT_GE(u[a], 0);
      ASSERT_LT(u[a], 1);
      means[a] += u[a] / n;
      for (std::size_t b = 0; b < a; ++b) products[a][b] += (u[a] - .5) * (u[b] - .5) / n;
    }
  }
  const double of_mean = std::sqrt(1. / 12 / n), of_product = 1. / 12 / std::sqrt(double(n));
  for (std::size_t a = 0; a < dimensions; ++a) {
    EXPECT_NEAR(means[a], .5, 5 * of_mean) << a;
    for (std::size_t b = 0; b < a; ++b) EXPECT_NEAR(products[a][b], 0, 5 * of_product) << a << ' ' << b;
  }
}

// Any single point is uniform over the seeds: what keeps means of few samples unbiased.
TEST_P(EverySequence, has_points_that_are_uniform_by_themselves) {
  ScalarMoments first, square;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    double u[5];
    make_sequence(GetParam(), seed)->point(17, u);
    first.add(u[3]);
    square.add(u[0] * u[4]);
  }
  EXPECT_NEAR(first.mean(), .5, 4 * first.standard_error());
  EXPECT_NEAR(square.mean(), .25, 4 * square.standard_error());
}

TEST_P(EverySequence, has_the_same_points_one_by_one_and_many_at_once) {
  const auto sequence = make_sequence(GetParam(), 8);
  for (const std::size_t dimensions : {1u, 5u, 9u}) {
    std::vector<double> many(70 * dimensions), one(dimensions);
    sequence->points(4090, dimensions, many);  // across a block of the stratified one
    for (std::size_t k = 0; k < 70; ++k) {
      sequence->point(4090 + k, one);
      for (std::size_t d = 0; d < dimensions; ++d) ASSERT_EQ(many[k * dimensions + d], one[d]) << k << ' ' << d;
    }
    const std::vector<std::uint64_t> which{7, 4095, 4096, 3, (std::uint64_t{1} << 33) + 5, 3};
    std::vector<double> some(which.size() * dimensions);
    sequence->points_of(which, dimensions, some);
    for (std::size_t k = 0; k < which.size(); ++k) {
      sequence->point(which[k], one);
      for (std::size_t d = 0; d < dimensions; ++d) ASSERT_EQ(some[k * dimensions + d], one[d]) << k << ' ' << d;
    }
  }
}

TEST_P(EverySequence, repeats) {
  const auto sequence = make_sequence(GetParam(), 8), again = make_sequence(GetParam(), 8);
  for (std::uint64_t k = 0; k < 100; ++k) {
    double u[4], v[4];
    sequence->point(k, u);
    again->point(k, v);
    for (std::size_t d = 0; d < 4; ++d) ASSERT_EQ(u[d], v[d]);
  }
}

// Means by two replications are off in ways of their own.
TEST_P(EverySequence, replicates_independently) {
  const auto deviation = [](const SampleSequence& sequence) {
    double sum = 0;
    for (std::uint64_t k = 0; k < 12; ++k) {
      double u[4];
      sequence.point(k, u);
      sum += u[0] * u[3] - .25;
    }
    return sum;
  };
  ScalarMoments products;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const auto sequence = make_sequence(GetParam(), seed);
    products.add(deviation(*sequence->replicate(1)) * deviation(*sequence->replicate(2)));
  }
  EXPECT_NEAR(products.mean(), 0, 4.5 * products.standard_error());
}

INSTANTIATE_TEST_SUITE_P(All, EverySequence, testing::ValuesIn(sequence_names()));

TEST(StratifiedSequence, has_one_in_each_stratum_of_each_dimension) {
  const auto sequence = make_sequence("stratified", 5);
  for (const std::uint64_t block : {0u, 3u}) {
    std::vector<int> found[3];
    for (auto& of : found) of.assign(4096, 0);
    for (std::uint64_t k = 0; k < 4096; ++k) {
      double u[3];
      sequence->point(4096 * block + k, u);
      for (std::size_t d = 0; d < 3; ++d) ++found[d][static_cast<std::size_t>(4096 * u[d])];
    }
    for (const auto& of : found) EXPECT_EQ(std::count(of.begin(), of.end(), 1), 4096);
  }
}

// Of a smooth integrand in four dimensions: independent ones have errors as n^-1/2, Sobol's nearly as n^-3/2.
TEST(SobolSequence, is_far_better_on_smooth_integrands) {
  const auto error = [](const std::string& name, int bits) {
    double squares = 0;
    for (std::uint64_t r = 0; r < 20; ++r) {
      const auto sequence = make_sequence(name, 1)->replicate(r);
      double sum = 0;
      for (std::uint64_t k = 0; k < (1u << bits); ++k) {
        double u[4];
        sequence->point(k, u);
        sum += std::exp(u[0] + .5 * u[1]) * (1 + u[2] * u[3]);
      }
      const double exact = (std::exp(1.) - 1) * 2 * (std::exp(.5) - 1) * 1.25;
      squares += std::pow(sum / (1u << bits) - exact, 2);
    }
    return std::sqrt(squares / 20);
  };
  const double independent = std::log2(error("independent", 8) / error("independent", 12)) / 4,
               sobol = std::log2(error("sobol", 8) / error("sobol", 12)) / 4;
  EXPECT_NEAR(independent, .5, .2);
  EXPECT_GT(sobol, 1.1);
  EXPECT_LT(error("stratified", 12), .5 * error("independent", 12));
}

TEST(SampleSequences, are_known_by_name) { EXPECT_THROW(make_sequence("halton", 1), InputError); }

}  // namespace
}  // namespace interflect::core
