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

/// P(|T| <= t) by n degrees of freedom is a finite sum in the angle a = atan(t / sqrt(n)) [Abramowitz, Stegun 1964,
/// 26.7.3-4].
static double probability_within(double t, int n) {
  const double a = std::atan(t / std::sqrt(static_cast<double>(n))), c = std::cos(a), s = std::sin(a);
  double term = n % 2 == 0 ? 1 : c, sum = n == 1 ? 0 : term;
  for (int k = n % 2 == 0 ? 2 : 3; k <= n - 2; k += 2) {
    term *= c * c * (k - 1) / k;
    sum += term;
  }
  return n % 2 == 0 ? s * sum : (a + s * sum) * 2 / pi;
}

double student_t(double confidence, int degrees_of_freedom) {
  if (!(confidence > 0 && confidence < 1) || degrees_of_freedom < 1)
    throw core::PreconditionError("student_t: 0 < confidence < 1 and a degree of freedom expected");
  double low = 0, high = 1;
  while (probability_within(high, degrees_of_freedom) < confidence) high *= 2;
  while (high - low > 1e-10 * high) {
    const double middle = 0.5 * (low + high);
    (probability_within(middle, degrees_of_freedom) < confidence ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace interflect::solvers
