#pragma once

#include "solvers/element_walks.h"

namespace interflect::solvers {

/// Discrete random walks from element to element [Pattanaik, Mudur 1995; Sbert 1997], by F_ij, that go on from j with
/// the probability rho_j: estimates of b = R G^-1 K (e + b), the reflected light, without any matrix.
///
/// **Shooting.** A walk is born at s with the probability G_s e_s / P, P = sum G e, with the power P.  It scores for
/// every element i that it comes to,
///
///   collision    rho_i P / G_i at every hit                    V = rho_i P / G_i b_i (1 + 2 xi_i) - b_i²
///   survival     P / G_i where it goes on                      V = P / G_i b_i (1 + 2 xi_i) - b_i²
///   absorption   rho_i / (1 - rho_i) P / G_i where it ends     V = rho_i / (1 - rho_i) P / G_i b_i - b_i²
///
/// V is the variance of a walk, xi_i = rho_i g_ii with g_ii the hits that light from i makes on i.
///
/// **Gathering.** Walks start at the element i that is asked about, and score rho_i times what they find at s,
///
///   collision    e_s at every hit                    V = rho_i sum_s (e_s + 2 b_s) b_is - b_i²
///   survival     e_s / rho_s where they go on        V = rho_i sum_s (e_s + 2 b_s) / rho_s b_is - b_i²
///   absorption   e_s / (1 - rho_s) where they end    V = rho_i sum_s e_s / (1 - rho_s) b_is - b_i²
///
/// b_is being the part of b_i that comes from s.
///
/// **Continuous** walks shoot, score collisions, and go on from the very point where they arrived: their mean is not
/// the solution of the equations but that of light itself, averaged over elements, since what arrives is not spread
/// over the element before it leaves.
///
/// Errors are by independent replications (replications.h).  Sources that reflect nothing are not found by gathering
/// with survival, nor what reflects everything by absorption: these are refused.
/// Test: tests/solvers/random_walk.cpp
class RandomWalk final : public RadiositySolver {
 public:
  enum class Way { shooting, gathering, continuous };
  using Score = ElementWalks::Score;
  RandomWalk(Way way, Score score, const SolverSettings& settings) : way_(way), score_(score), settings_(settings) {}
  std::string name() const override;
  SolverReport advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const override;

 private:
  Way way_;
  Score score_;
  SolverSettings settings_;
};

}  // namespace interflect::solvers
