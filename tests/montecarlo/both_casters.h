#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/estimate.h"
#include "core/moments.h"
#include "tests/support/family.h"

/// Answers with rays in single precision (Embree) and in double, by the same numbers.
///
/// Places that are met differ by delta = 2^-24 of the scene, and what a path finds is divided, at each of its
/// vertices, by a cosine and twice by a distance.  A factor that is uniform in 0 .. 1 changes by more than a part x of
/// itself with the probability delta / x.  So does the mean over many paths, of which each has one: it is their few
/// large changes that make it change.  Of paths of ten vertices
///
///   P(an answer changes by more than a part x) = 30 delta / x
///
/// where that is small: .018 of x = 1e-4.  Rays that meet an edge, and go on beside it, are one in a million.
namespace interflect::test {

inline constexpr double close_by = 1e-4, share_of_others = 30 * 0x1p-24 / close_by;

/// (a - b) over what they find and may be off by, in the channel where that is furthest from zero: of controlled paths
/// what is found may be nearly nothing, the difference of much.
inline double apart(const Estimate& a, const Estimate& b, int channels) {
  double most = 0;
  for (int c = 0; c < channels; ++c) {
    const double size = std::abs(a.value[c]) + a.standard_error[c];
    if (size == 0 && b.value[c] == 0) continue;
    const double each = size == 0 ? -1 : (a.value[c] - b.value[c]) / size;
    if (std::abs(each) > std::abs(most)) most = each;
  }
  return most;
}

struct Compared {
  core::ScalarMoments differences;
  int found = 0, others = 0;

  Compared(const std::vector<Estimate>& one, const std::vector<Estimate>& other, int channels) {
    for (std::size_t m = 0; m < one.size(); ++m) {
      const double each = apart(one[m], other[m], channels);
      differences.add(each);
      others += std::abs(each) > close_by;
      found += !one[m].value.is_zero();
    }
  }
  double all() const { return static_cast<double>(differences.count()); }
};

/// Of a number that few are expected of (Poisson), what it is beyond with no more than this probability.
/// @pre  expected < 700, so that none at all is not impossible
inline int most_of_few(double expected, double level) {
  double term = std::exp(-expected), rest = 1 - term;
  int k = 0;
  while (rest > level) rest -= term *= expected / ++k;
  return k;
}

/// One tail of the family.
inline void expect_few_others(const Compared& by_both, Family& family, const std::string& name) {
  EXPECT_GT(by_both.found, .1 * by_both.all()) << name;
  EXPECT_LE(by_both.others, most_of_few(share_of_others * by_both.all(), family.level()))
      << name << ": of " << by_both.all();
}

}  // namespace interflect::test
