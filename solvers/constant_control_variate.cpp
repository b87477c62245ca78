#include "solvers/constant_control_variate.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/error.h"
#include "core/format.h"
#include "core/ordered_sum.h"
#include "core/random.h"
#include "solvers/transition_sampler.h"

namespace interflect::solvers {
namespace {

/// The least x with half of all weight at x or below.
double weighted_median(const Eigen::VectorXd& x, const Eigen::VectorXd& weight) {
  std::vector<Index> order(static_cast<std::size_t>(x.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return x(a) < x(b); });
  const double all = core::ordered_sum(weight);
  double below = 0;
  for (const Index a : order)
    if ((below += weight(a)) >= .5 * all) return x(a);
  return x(order.back());
}

}  // namespace

ConstantControlVariate::ConstantControlVariate(const System& system, const ColumnMatrix& power, const BounceFactory& of)
    : beta_(power.cols()) {
  const Eigen::Map<const Eigen::VectorXd> G(system.K.gram().data(), power.rows());
  for (Index c = 0; c < power.cols(); ++c) beta_(c) = weighted_median(power.col(c).cwiseQuotient(G), G);
  const ColumnMatrix constant = G * beta_;
  left_ = power - constant;
  reflected_ = system.R.reflectance().cwiseProduct(constant);
  bounce_ = of(left_);
}

void ConstantControlVariate::add(const core::SampleSequence& sequence, std::uint64_t first, std::uint64_t count,
                                 double weight, ColumnMatrix& reflected) const {
  reflected += weight * reflected_;
  bounce_->add(sequence, first, count, weight, reflected);
}

void require_closed(const System& system, const std::string& solver, const Run& run) {
  constexpr Index at_least = 20000;
  constexpr double grazing = 1e-3;  // rays that slip through seams
  const Index n = system.e.rows(), each = (at_least + n - 1) / n;
  const auto seed = core::derived_seed(run.seed, "closed room");
  std::vector<double> u(static_cast<std::size_t>(system.walks->dimensions()));
  Index lost = 0;
  for (Index i = 0; i < n; ++i)
    for (Index k = 0; k < each; ++k) {
      core::RandomNumbers numbers(seed, static_cast<std::uint32_t>(k), static_cast<std::uint64_t>(i));
      for (double& number : u) number = numbers.next();
      if (!system.walks->from_element(i, u)) ++lost;
    }
  const double share = static_cast<double>(lost) / static_cast<double>(n * each);
  if (share > grazing)
    throw core::InputError("solver '" + solver + "'", "a closed room expected; of rays that leave elements " +
                                                          core::format_percent(share) + " arrive nowhere");
}

}  // namespace interflect::solvers
