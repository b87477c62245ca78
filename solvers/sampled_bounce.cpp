#include "solvers/sampled_bounce.h"

#include <algorithm>
#include <cmath>

namespace interflect::solvers {
namespace {

/// The largest of the quotients of columns, 0 where there is nothing.
double largest_share(const Eigen::RowVectorXd& part, const Eigen::RowVectorXd& of) {
  double largest = 0;
  for (Index c = 0; c < of.size(); ++c)
    if (of(c) > 0) largest = std::max(largest, part(c) / of(c));
  return largest;
}

Eigen::RowVectorXd sums(const ColumnMatrix& power) { return power.cwiseAbs().colwise().sum(); }

}  // namespace

ColumnMatrix Bounces::bounced(const SampledBounce& bounce, Index rows, Index columns, std::uint64_t samples) {
  ColumnMatrix reflected = ColumnMatrix::Zero(rows, columns);
  bounce.add(*sequence_.replicate(bounces_++), 0, samples, 1, reflected);
  draws_ += samples;
  return reflected;
}

ColumnMatrix Bounces::bounced(const ColumnMatrix& power, std::uint64_t samples) {
  return bounced(*of_(power), power.rows(), power.cols(), samples);
}

double Bounces::number() {
  double u[1];
  sequence_.replicate(bounces_++)->point(0, u);
  return u[0];
}

ColumnMatrix Bounces::incremental(const ColumnMatrix& emitted, std::uint64_t samples,
                                  const std::function<void()>& between) {
  constexpr double little = 1e-7;
  const Eigen::RowVectorXd all = sums(emitted);
  ColumnMatrix sum = ColumnMatrix::Zero(emitted.rows(), emitted.cols()), last = emitted;
  for (Eigen::RowVectorXd first, first_worth;;) {
    between();
    const auto bounce = of_(last);
    if (first.size() == 0) first = bounce->sizes(), first_worth = bounce->worths();
    const double by_size = largest_share(bounce->sizes(), first);
    const double share = std::clamp(largest_share(bounce->worths(), first_worth), .5 * by_size, 4 * by_size);
    const auto asked = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(samples)));
    ColumnMatrix next = bounced(*bounce, last.rows(), last.cols(), std::max(bounce->least_samples(), asked));
    sum += next;
    const double kept = std::min(1.0, largest_share(sums(next), sums(last)));
    last = std::move(next);
    if (largest_share(sums(last), all) > little) continue;
    if (!(number() < kept)) return sum;
    last /= kept;
  }
}

}  // namespace interflect::solvers
