#pragma once

#include "solvers/element_walks.h"

namespace interflect::solvers {

/// What walks are worth, and how many of them are best: by the exact variances of a shooting and a gathering walk with
/// collision scores (random_walk.h),
///
///   V_s = rho P / G b (1 + 2 xi) - b²,     V_g = rho sum_s (e_s + 2 b_s) b_is - b²
///
/// in which sum_s (e_s + 2 b_s) b_is is the reflected light of the exitance e (e + 2 b).  N walks that shoot and n_i
/// that gather at i, averaged by 1 / variance, leave 1 / (N / V_s + n_i / V_g) at i.  Of all that cost as much those
/// have the least sum_i G_i / (N / V_s,i + n_i / V_g,i) that have, with N = 1 and one lambda,
///
///   n_i = V_g max(0, sqrt(G_i / (lambda V_g)) - 1 / V_s),     sum_i G_i / V_s / (1 / V_s + n_i / V_g)² = lambda
///
/// (lambda: what a walk more would gain).  Several columns count by their variances over sum G b² of each.
struct WalkPlan {
  ColumnMatrix shooting, gathering;  ///< V of each unknown and column, as estimated
  Eigen::VectorXd gathered;          ///< n_i, for every walk that shoots
};
constexpr double most_gathering_walks = 1e4;  ///< for one that shoots
/// @param shooting, gathering  V, of one walk
/// @param scale  of each column, that its variances are measured by
/// @param most  that gather, for one that shoots
WalkPlan plan_walks(ColumnMatrix shooting, ColumnMatrix gathering, std::span<const double> areas,
                    const Eigen::RowVectorXd& scale, double most = most_gathering_walks);

/// Shooting and gathering walks together [Sbert 1997], of constants: variances are found by a few rays first, are the
/// same for all replications, and are only weights, so that means are right whatever they are.
/// Test: tests/solvers/combined_walks.cpp
class CombinedWalks final : public RadiositySolver {
 public:
  explicit CombinedWalks(const SolverSettings& settings) : settings_(settings) {}
  std::string name() const override { return "shooting-and-gathering"; }
  SolverReport advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const override;

 private:
  SolverSettings settings_;
};

}  // namespace interflect::solvers
