#pragma once

#include <cmath>

namespace interflect::fem {

/// An integral and what its error is estimated to be at most.
struct Integral {
  double value = 0, error = 0;
};

/// A sum and the sizes of its terms, from which its rounding is estimated.
struct SizedSum {
  double value = 0, size = 0;
  void add(double term) { value += term, size += std::abs(term); }
};

}  // namespace interflect::fem
