#include "core/sample_sequence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/error.h"
#include "core/moments.h"
#include "tests/core/sequence/statistics.h"

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

// Any single point is uniform over the seeds, and so is each two of its numbers: what keeps means of few samples
// unbiased, and what fails where dimensions share a randomisation.  Alpha 1e-6 over all numbers, pairs and sequences.
TEST_P(EverySequence, has_points_that_are_uniform_by_themselves) {
  constexpr std::size_t dimensions = 16, pairs = dimensions * (dimensions - 1) / 2;
  const std::vector<std::uint64_t> which{0, 1, 6, 4095, (std::uint64_t{1} << 33) + 5};
  const double alpha = 1e-6 / double(which.size() * (dimensions + pairs) * sequence_names().size());
  std::vector<test::Cells> one(which.size() * dimensions, test::Cells(64)), two(which.size() * pairs, test::Cells(256));
  std::vector<double> u(which.size() * dimensions);
  for (std::uint64_t seed = 0; seed < 1 << 14; ++seed) {
    make_sequence(GetParam(), seed)->points_of(which, dimensions, u);
    for (std::size_t k = 0, pair = 0; k < which.size(); ++k)
      for (std::size_t a = 0; a < dimensions; ++a) {
        const double* const x = &u[k * dimensions];
        one[k * dimensions + a].add(test::interval_of(x[a], 64));
        for (std::size_t b = 0; b < a; ++b)
          two[pair++].add(16 * test::interval_of(x[a], 16) + test::interval_of(x[b], 16));
      }
  }
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_TRUE(one[i].uniform(alpha)) << i << ' ' << one[i].chi_squared();
  for (std::size_t i = 0; i < two.size(); ++i) EXPECT_TRUE(two[i].uniform(alpha)) << i << ' ' << two[i].chi_squared();
}

// Whatever part is asked for, in whatever order.
TEST_P(EverySequence, has_numbers_from_any_dimension_on) {
  const auto sequence = make_sequence(GetParam(), 8);
  for (const std::uint64_t k : {std::uint64_t{4097}, (std::uint64_t{1} << 33) + 5, std::uint64_t{2}}) {
    double all[80];
    sequence->point(k, all);
    for (std::size_t first = 80; first-- > 0;)
      for (std::size_t count = 0; count < 8 && first + count <= 80; ++count) {
        double some[8];
        sequence->numbers(k, first, {some, count});
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(some[i], all[first + i]) << k << ' ' << first << ' ' << count;
      }
  }
}

TEST_P(EverySequence, has_numbers_in_the_unit_interval) {
  constexpr std::uint64_t largest = ~std::uint64_t{0};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto sequence = make_sequence(GetParam(), largest - seed);
    for (std::uint64_t k = 0; k < 200; ++k)
      for (const std::uint64_t at : {k, largest - k, (std::uint64_t{1} << 32) - 1 - k})
        for (const std::size_t first : {std::size_t{0}, std::size_t{60}, std::size_t{1} << 20}) {
          double u[9];
          sequence->numbers(at, first, u);
          for (const double number : u) {
            ASSERT_GE(number, 0);
            ASSERT_LT(number, 1);
          }
        }
  }
}

TEST_P(EverySequence, has_the_same_points_one_by_one_and_many_at_once) {
  const auto sequence = make_sequence(GetParam(), 8);
  for (const std::size_t dimensions : {1u, 5u, 9u}) {
    std::vector<double> many(70 * dimensions), one(dimensions);
    sequence->points(4090, dimensions, many);  // across a block of strata
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

// Numbers of two replications, of the same dimension and of others, and of a sequence and of one of its replications,
// are independent.  Alpha 1e-6 over all.
TEST_P(EverySequence, shares_no_number_with_its_replications) {
  constexpr std::size_t dimensions = 6;
  const double alpha = 1e-6 / double(3 * dimensions * dimensions * sequence_names().size());
  std::vector<test::Cells> joint(3 * dimensions * dimensions, test::Cells(64));
  for (std::uint64_t seed = 0; seed < 1 << 13; ++seed) {
    const auto sequence = make_sequence(GetParam(), seed);
    double u[4][dimensions];
    sequence->point(5, u[0]);
    for (std::uint64_t r = 0; r < 3; ++r) sequence->replicate(r)->point(5, u[r + 1]);
    std::size_t at = 0;
    for (const auto& [x, y] : {std::pair{u[0], u[1]}, {u[1], u[2]}, {u[1], u[3]}})
      for (std::size_t a = 0; a < dimensions; ++a)
        for (std::size_t b = 0; b < dimensions; ++b)
          joint[at++].add(8 * test::interval_of(x[a], 8) + test::interval_of(y[b], 8));
  }
  for (std::size_t i = 0; i < joint.size(); ++i)
    EXPECT_TRUE(joint[i].uniform(alpha)) << i << ' ' << joint[i].chi_squared();
}

INSTANTIATE_TEST_SUITE_P(All, EverySequence, testing::ValuesIn(sequence_names()), [](const auto& each) {
  std::string name = each.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

// Solvers' results are functions of these numbers: hashes of them as they were when the sequences were one file.
TEST(SampleSequences, that_solvers_use_keep_their_numbers) {
  const auto hash_of = [](const std::string& name) {
    std::uint64_t hash = 0xCBF29CE484222325u;  // FNV-1a, number after number
    for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{7}, std::uint64_t{0x123456789ABCDEF}})
      for (const bool replicated : {false, true}) {
        auto sequence = make_sequence(name, seed);
        if (replicated) sequence = sequence->replicate(3);
        for (const std::uint64_t k : {0ul, 1ul, 77ul, 4095ul, 4096ul, (1ul << 33) + 5})
          for (const std::size_t dimensions : {1u, 7u, 12u}) {
            std::vector<double> u(dimensions);
            sequence->point(k, u);
            for (const double number : u) hash = (hash ^ std::bit_cast<std::uint64_t>(number)) * 0x100000001B3u;
          }
      }
    return hash;
  };
  EXPECT_EQ(hash_of("independent"), 0x47E4B61DBA490F67u);
  EXPECT_EQ(hash_of("latin-hypercube"), 0xF125CBD35319845Au);
  EXPECT_EQ(hash_of("sobol"), 0x7D523C2273BE3180u);
}

// Each two dimensions of independent points, by 65 536 of them: alpha 1e-6 over all 120, two-sided.
TEST(IndependentSequence, has_dimensions_that_are_independent) {
  constexpr std::size_t dimensions = 16, n = 1 << 16;
  const auto sequence = make_sequence("independent", 2);
  std::vector<double> u(n * dimensions);
  sequence->points(0, dimensions, u);
  for (std::size_t a = 0; a < dimensions; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      test::Cells cells(256);
      for (std::size_t k = 0; k < n; ++k)
        cells.add(16 * test::interval_of(u[k * dimensions + a], 16) + test::interval_of(u[k * dimensions + b], 16));
      EXPECT_TRUE(cells.uniform(1e-6 / 240)) << a << ' ' << b << ' ' << cells.chi_squared();
      EXPECT_FALSE(cells.uniform(1 - 1e-6 / 240)) << a << ' ' << b << ' ' << cells.chi_squared();
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
  const auto rate = [&](const std::string& name) { return std::log2(error(name, 8) / error(name, 12)) / 4; };
  EXPECT_NEAR(rate("independent"), .5, .2);
  EXPECT_GT(rate("sobol"), 1.1);
  EXPECT_GT(rate("sobol-owen"), 1.1);
  EXPECT_GT(rate("halton"), .75);
  for (const char* name : {"stratified", "latin-hypercube", "zero-two"})
    EXPECT_LT(error(name, 12), .5 * error("independent", 12)) << name;
}

TEST(SampleSequences, are_known_by_name) {
  for (const SequenceEntry& each : known_sequences()) EXPECT_FALSE(each.summary.empty()) << each.name;
  try {
    make_sequence("hammersley", 1);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    for (const std::string& name : sequence_names())
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace interflect::core
