#pragma once

#include <vector>

#include "core/moments.h"

namespace interflect::core {

/// int f by the help of a g that is like it and whose integral G is known:
///
///   <F> = mean of f - c (g - G),   c = Cov(f, g) / Var(g),   Var <F> = (1 - corr²) Var <f>
///
/// Samples are dealt out to batches in turn, and each batch takes the c that all others have: with its own the estimate
/// would be biased by O(1 / n).  Standard errors are by batches.
class ControlVariate {
 public:
  /// @param known    G
  /// @param batches  3 or more
  ControlVariate(double known, int batches);

  void add(double f, double g);

  /// c of all samples, for others than these: a pilot's.  0 where g does not vary.
  double factor() const { return best_factor(all_); }

  struct Result {
    double mean, standard_error;
  };
  /// Where no batch has a sample, 0 with an infinite error.
  Result result() const;

 private:
  struct Sums {
    double n = 0, f = 0, g = 0, fg = 0, gg = 0;  ///< g less G
    Sums operator-(const Sums& other) const {
      return {n - other.n, f - other.f, g - other.g, fg - other.fg, gg - other.gg};
    }
  };
  static double best_factor(const Sums& of);

  double known_;
  std::size_t next_ = 0;
  std::vector<Sums> of_;
  Sums all_;
};

}  // namespace interflect::core
