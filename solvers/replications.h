#pragma once

#include <functional>

#include "core/run.h"
#include "solvers/transport_operator.h"

namespace interflect::solvers {

/// Independent repetitions of an estimate of all unknowns: their mean, and its standard error by how they differ, which
/// has count() - 1 degrees of freedom whatever is inside a repetition.
class Replications {
 public:
  Replications(Index unknowns, Index columns, int count);

  int count() const { return static_cast<int>(sums_.size()); }
  /// More for every repetition, in parallel: add(number, its sum of scores so far).
  void add(const Run& run, const std::function<void(int number, ColumnMatrix& sum)>& add);

  /// @param samples  that each repetition has
  ColumnMatrix mean(double samples) const;
  ColumnMatrix standard_error(double samples) const;
  /// Of w^T times what is estimated, whatever the correlations of unknowns are: mean and standard error of each column.
  std::pair<Eigen::RowVectorXd, Eigen::RowVectorXd> weighed(std::span<const double> w, double samples) const;

 private:
  std::vector<ColumnMatrix> sums_;
};

}  // namespace interflect::solvers
