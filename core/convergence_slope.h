#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace interflect::core {

/// How fast the error of a sampled mean falls with the number of its samples: the slope s of RMSE ~ n^s.
///
/// Of R independent randomisations each has the means m_r(n) of its first n samples; they are unbiased, so that
///
///   RMSE(n)² = sum_r (m_r(n) - mean over r)² / (R - 1),     s by least squares of log RMSE on log n,
///   SE² = (R - 1) / R sum_r (s_-r - mean over r)²,          s_-r the slope without randomisation r: the jackknife
///
/// The jackknife heeds that means of one randomisation are parts of each other.  Independent samples: s = -1/2.
/// Test: tests/core/convergence_slope.cpp
struct ConvergenceSlope {
  std::vector<double> rmse;  ///< of each number of samples, in the means' unit
  double slope, standard_error;
  int degrees_of_freedom;  ///< of the standard error, R - 1

  /// Half of the interval about `slope` that holds the true one with this confidence.
  double half_width(double confidence = 0.95) const;
};

/// @param samples  n, growing: at least two
/// @param means    [randomisation][which n], at least three randomisations
/// @throws PreconditionError  otherwise
ConvergenceSlope convergence_slope(std::span<const std::uint64_t> samples, std::span<const std::vector<double>> means);

}  // namespace interflect::core
