#pragma once

#include "core/vec.h"

namespace interflect::core {

/// The sum of a vector's values in an order that depends on their number alone.  Eigen's own `sum()` of values that lie in
/// memory starts where vector registers may load from, and so has other last bits where the same values lie elsewhere:
/// not the same from run to run.  (Its sums of expressions, as of products, start at the first.)
template <class Derived>
double ordered_sum(const Eigen::DenseBase<Derived>& values) {
  constexpr Index together = 4;  // sums that do not wait for each other
  const auto& v = values.derived();
  double sums[together] = {};
  const Index whole = v.size() - v.size() % together;
  for (Index i = 0; i < whole; i += together)
    for (Index k = 0; k < together; ++k) sums[k] += v.coeff(i + k);
  for (Index i = whole; i < v.size(); ++i) sums[0] += v.coeff(i);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace interflect::core
