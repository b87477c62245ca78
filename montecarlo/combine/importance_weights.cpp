#include "montecarlo/combine/importance_weights.h"

#include <Eigen/QR>

namespace interflect::montecarlo {

double importance_weight(Heuristic heuristic, std::span<const double> n, std::span<const double> p, std::size_t i) {
  const auto part = [&](std::size_t k) {
    const double each = n[k] * p[k];
    return heuristic == Heuristic::power ? each * each : each;
  };
  double all = 0;
  for (std::size_t k = 0; k < p.size(); ++k) all += part(k);
  return all > 0 ? part(i) / all : 0;
}

OptimalWeights::OptimalWeights(std::span<const double> n)
    : n_(Eigen::Map<const Eigen::VectorXd>(n.data(), std::ssize(n))),
      b_(Eigen::VectorXd::Zero(n_.size())),
      alpha_(b_),
      A_(Eigen::MatrixXd::Zero(n_.size(), n_.size())) {}

double OptimalWeights::mixture(std::span<const double> p) const {
  return n_.dot(Eigen::Map<const Eigen::VectorXd>(p.data(), std::ssize(p)));
}

/// Samples of all techniques together have the density q: int g / q = E sum g / q².
void OptimalWeights::learn(double f, std::span<const double> p, double times) {
  const Eigen::Map<const Eigen::VectorXd> of(p.data(), std::ssize(p));
  const double q = mixture(p);
  if (!(q > 0)) return;
  A_ += of * of.transpose() * (times / (q * q));
  b_ += of * (f * times / (q * q));
}

void OptimalWeights::solve() { alpha_ = A_.completeOrthogonalDecomposition().solve(b_); }

double OptimalWeights::score(double f, std::span<const double> p) const {
  const double q = mixture(p);
  return q > 0 ? (f - alpha_.dot(Eigen::Map<const Eigen::VectorXd>(p.data(), std::ssize(p)))) / q : 0;
}

}  // namespace interflect::montecarlo
