#include "solvers/sampled_bounce.h"

#include <algorithm>
#include <cmath>

#include "solvers/power_draw.h"

namespace interflect::solvers {
namespace {

/// The largest of the quotients of columns, 0 where there is nothing.
double largest_share(const Eigen::RowVectorXd& part, const Eigen::RowVectorXd& of) {
  double largest = 0;
  for (Index c = 0; c < of.size(); ++c)
    if (of(c) > 0) largest = std::max(largest, part(c) / of(c));
  return largest;
}

}  // namespace

void Bounces::bounced(const SampledBounce& bounce, std::uint64_t samples, ColumnMatrix& reflected) {
  reflected.setZero();
  bounce.add(*sequence_.replicate(bounces_++), 0, samples, 1, reflected);
  draws_ += samples;
}

ColumnMatrix Bounces::bounced(const ColumnMatrix& power, std::uint64_t samples) {
  ColumnMatrix reflected(power.rows(), power.cols());
  bounced(*of_(power), samples, reflected);
  return reflected;
}

double Bounces::number() {
  double u[1];
  sequence_.replicate(bounces_++)->point(0, u);
  return u[0];
}

ColumnMatrix Bounces::incremental(const ColumnMatrix& emitted, std::uint64_t samples,
                                  const std::function<void()>& between) {
  const double little = std::max(1e-7, 1 / static_cast<double>(samples));  // what one sample carries
  const Eigen::RowVectorXd all = column_sizes(emitted);
  Eigen::RowVectorXd sent = all;
  ColumnMatrix sum = ColumnMatrix::Zero(emitted.rows(), emitted.cols()), last = emitted, next = emitted;
  for (Eigen::RowVectorXd first, first_worth;;) {
    between();
    const auto bounce = of_(last);
    if (first.size() == 0) first = bounce->sizes(), first_worth = bounce->worths();
    const double by_size = largest_share(bounce->sizes(), first);
    const double share = std::clamp(largest_share(bounce->worths(), first_worth), .5 * by_size, 4 * by_size);
    const auto asked = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(samples)));
    bounced(*bounce, std::max(bounce->least_samples(), asked), next);
    sum += next;
    const Eigen::RowVectorXd came = column_sizes(next);
    const double kept = std::min(1.0, largest_share(came, sent));
    std::swap(last, next), sent = came;
    if (largest_share(sent, all) > little) continue;
    if (!(number() < kept)) return sum;
    last /= kept, sent /= kept;
  }
}

}  // namespace interflect::solvers
