#include "solvers/replications.h"

#include <cmath>

#include "core/error.h"

namespace interflect::solvers {

Replications::Replications(Index unknowns, Index columns, int count) {
  if (count < 2) throw core::PreconditionError("replications: two or more expected");
  sums_.assign(static_cast<std::size_t>(count), ColumnMatrix::Zero(unknowns, columns));
}

void Replications::add(const Run& run, const std::function<void(int number, ColumnMatrix& sum)>& add) {
  run.threads.for_blocks(
      count(), 1, [&](Index number, Index) { add(static_cast<int>(number), sums_[static_cast<std::size_t>(number)]); });
}

ColumnMatrix Replications::mean(double samples) const {
  ColumnMatrix sum = ColumnMatrix::Zero(sums_[0].rows(), sums_[0].cols());
  for (const ColumnMatrix& each : sums_) sum += each;
  return sum / (samples * count());
}

ColumnMatrix Replications::standard_error(double samples) const {
  const ColumnMatrix middle = mean(samples);
  ColumnMatrix squares = ColumnMatrix::Zero(middle.rows(), middle.cols());
  for (const ColumnMatrix& each : sums_) squares += (each / samples - middle).cwiseAbs2();
  return (squares / (count() * (count() - 1.0))).cwiseSqrt();
}

std::pair<Eigen::RowVectorXd, Eigen::RowVectorXd> Replications::weighed(std::span<const double> w,
                                                                        double samples) const {
  const Eigen::Map<const Eigen::RowVectorXd> weights(w.data(), sums_[0].rows());
  Replications of_one(1, sums_[0].cols(), count());
  for (std::size_t r = 0; r < sums_.size(); ++r) of_one.sums_[r] = weights * sums_[r];
  return {of_one.mean(samples), of_one.standard_error(samples)};
}

}  // namespace interflect::solvers
