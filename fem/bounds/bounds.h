#pragma once

#include <cmath>
#include <limits>

#include "core/interval.h"
#include "fem/columns.h"

namespace interflect::fem {

/// Lower and upper bounds, per channel.  One that is no number says that nothing is known, and what it widens, or is a
/// part of, is not known either.
struct Bounds {
  Eigen::RowVectorXd lower, upper;

  static Bounds zero(Index channels) {
    return {Eigen::RowVectorXd::Zero(channels), Eigen::RowVectorXd::Zero(channels)};
  }
  /// Of nothing yet: to be widened.
  static Bounds none(Index channels) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {Eigen::RowVectorXd::Constant(channels, infinity), Eigen::RowVectorXd::Constant(channels, -infinity)};
  }
  void widen(const Bounds& to) {
    for (Index c = 0; c < lower.size(); ++c) {
      if (!(to.lower[c] >= lower[c]) && !std::isnan(lower[c])) lower[c] = to.lower[c];
      if (!(to.upper[c] <= upper[c]) && !std::isnan(upper[c])) upper[c] = to.upper[c];
    }
  }
  Bounds widened(double by) const { return {lower.array() - by, upper.array() + by}; }
  Bounds scaled(const Eigen::RowVectorXd& by) const {
    return {lower.cwiseProduct(by), upper.cwiseProduct(by)};
  }  ///< >= 0
  Bounds operator+(const Bounds& other) const { return {lower + other.lower, upper + other.upper}; }
};

/// Of many things, per channel; of what nothing is known at first.
struct ManyBounds {
  solvers::ColumnMatrix lower, upper;

  ManyBounds(Index rows, Index channels)
      : lower(solvers::ColumnMatrix::Constant(rows, channels, -std::numeric_limits<double>::infinity())),
        upper(solvers::ColumnMatrix::Constant(rows, channels, std::numeric_limits<double>::infinity())) {}

  /// By both; what is no number narrows nothing.
  void narrow(Index row, const Bounds& to) {
    for (Index c = 0; c < lower.cols(); ++c) {
      if (to.lower[c] > lower(row, c)) lower(row, c) = to.lower[c];
      if (to.upper[c] < upper(row, c)) upper(row, c) = to.upper[c];
    }
  }
  Interval of(Index row) const { return {to_spectrum(lower.row(row)), to_spectrum(upper.row(row))}; }
};

}  // namespace interflect::fem
