#include "core/control_variate.h"

#include <limits>

#include "core/error.h"

namespace interflect::core {

ControlVariate::ControlVariate(double known, int batches) : known_(known), of_(static_cast<std::size_t>(batches)) {
  if (batches < 3) throw PreconditionError("control variate: three batches or more expected");
}

void ControlVariate::add(double f, double g) {
  g -= known_;
  for (Sums* sums : {&of_[next_], &all_}) {
    ++sums->n;
    sums->f += f, sums->g += g, sums->fg += f * g, sums->gg += g * g;
  }
  next_ = (next_ + 1) % of_.size();
}

double ControlVariate::best_factor(const Sums& of) {
  const double covariance = of.fg - of.f * of.g / of.n, variance = of.gg - of.g * of.g / of.n;
  return variance > 0 ? covariance / variance : 0;
}

ControlVariate::Result ControlVariate::result() const {
  ScalarMoments batches;
  for (const Sums& own : of_) {
    const Sums others = all_ - own;
    if (own.n == 0 || others.n == 0) continue;
    batches.add((own.f - best_factor(others) * own.g) / own.n);
  }
  if (batches.count() == 0) return {0, std::numeric_limits<double>::infinity()};
  return {batches.mean(), batches.standard_error()};
}

}  // namespace interflect::core
