#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fem/form_factor/adaptive_lambert.h"
#include "fem/form_factor/contour.h"
#include "fem/form_factor/pair_integral.h"
#include "fem/form_factor/polygon_pair.h"
#include "scene/place.h"
#include "tests/fem/random_pairs.h"

namespace interflect::fem {
namespace {

using test::every_nearness;
using test::Nearness;
using test::RandomPairs;
using test::RingPair;

/// Stated over true errors of many pairs.
class StatedErrors {
 public:
  /// @param exact  with an error well below what is stated, else the pair says nothing
  void add(double value, double stated, const Integral& exact) {
    if (stated < 20 * exact.error) return;
    ratios_.push_back(stated / std::max(std::abs(value - exact.value), exact.error));
  }
  double median() {
    std::nth_element(ratios_.begin(), ratios_.begin() + static_cast<Index>(ratios_.size() / 2), ratios_.end());
    return ratios_[ratios_.size() / 2];
  }
  /// At most 1 % worse than stated, and four standard deviations of chance: false alarms in 3e-5 of all tests.
  bool hold() const {
    const auto n = static_cast<double>(ratios_.size()),
               worse =
                   static_cast<double>(std::count_if(ratios_.begin(), ratios_.end(), [](double r) { return r < 1; }));
    return worse <= 0.01 * n + 4 * std::sqrt(0.01 * n);
  }
  std::size_t size() const { return ratios_.size(); }

 private:
  std::vector<double> ratios_;
};

Integral lambert(const RingPair& pair, double tolerance) {
  const bool a_is_outer = test::area_of(pair.a) < test::area_of(pair.b);
  const geometry::Ring &outer = a_is_outer ? pair.a : pair.b, &inner = a_is_outer ? pair.b : pair.a;
  return adaptive_lambert(outer, test::normal_of(outer), inner, tolerance);
}

// 5 x 400 pairs each at tolerances from 1e-2 to 1e-5: that share a corner or an edge, nearly touch, are near, and far.
TEST(StatedErrors, of_lambert_quadrature_hold_in_99_percent_and_are_not_far_above) {
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    StatedErrors errors;
    for (const Nearness nearness : every_nearness) {
      RandomPairs random(8);
      for (int k = 0; k < 400; ++k) {
        const RingPair pair = random.pair(nearness);
        const Integral found = lambert(pair, tolerance);
        errors.add(found.value, found.error, polygon_pair(pair.a, pair.b, 1e-12));
      }
    }
    EXPECT_GT(errors.size(), 1500u);
    EXPECT_TRUE(errors.hold()) << tolerance;
    EXPECT_LT(errors.median(), 10) << tolerance;
  }
}

// Of what the guard picks, whatever that is; and no pair of these is above its tolerance.
TEST(StatedErrors, of_pairs_hold_in_99_percent_and_are_within_the_tolerance) {
  for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
    StatedErrors errors;
    for (const Nearness nearness : every_nearness) {
      RandomPairs random(9);
      for (int k = 0; k < 400; ++k) {
        const RingPair pair = random.pair(nearness);
        const std::vector patches{scene::make_patch({0}, scene::Side::front, pair.a),
                                  scene::make_patch({1}, scene::Side::front, pair.b)};
        const PairIntegral found = PairIntegrator(patches, tolerance)(0, 1);
        EXPECT_LE(found.error, tolerance * found.value);
        if (found.facing == Facing::full) errors.add(found.value, found.error, polygon_pair(pair.a, pair.b, 1e-13));
      }
    }
    EXPECT_GT(errors.size(), 500u);
    EXPECT_TRUE(errors.hold()) << tolerance;
  }
}

// Closed forms differ by rounding; the difference of two of them is below the sum of what both state.
TEST(StatedErrors, of_closed_forms_hold_in_99_percent) {
  for (const Nearness nearness : every_nearness) {
    RandomPairs random(10);
    int worse = 0;
    constexpr int pairs = 2000;
    for (int k = 0; k < pairs; ++k) {
      const RingPair pair = random.pair(nearness);
      const Integral closed = polygon_pair(pair.a, pair.b, 1), contour = double_contour(pair.a, pair.b);
      worse += std::abs(closed.value - contour.value) > closed.error + contour.error;
    }
    EXPECT_LE(worse, 0.01 * pairs);
  }
}

}  // namespace
}  // namespace interflect::fem
