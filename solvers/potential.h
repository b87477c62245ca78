#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "solvers/sampled_bounce.h"
#include "solvers/solver.h"

namespace interflect::solvers {

/// What light is worth to a target J = sum_a t_a b_a: the adjoint of radiosity [Pattanaik, Mudur 1995; Smits, Arvo,
/// Salesin 1992], estimated by rays.  With psi = t / G and F_ij = K_ij / G_i, power that is received by i adds
///
///   q_i = rho_i (psi_i + sum_j F_ij q_j)        to J, a unit of it:  sum t (b - e) = sum_j G_j e_j sum_i F_ji q_i
///
/// which are the equations of radiosity with R psi for an exitance.  What scores vary by are second moments:
///
///   of a bounce   w_j² = sum_i F_ji q_i²                                         of what is sent by j and scores q_i
///   of a walk     w_j² = sum_i F_ji M_i,   M_i = s_i (2 q_i - s_i) + rho_i sum_j F_ij M_j,  s = R psi
///
/// the latter of collision scores s_i at every hit of a walk that survives by rho.  Whoever draws what is sent in
/// proportion to P w has the least variance of J:  (sum P w)² - J_r², against sum P sum P w² - J_r² where drawn by
/// power, J_r of what is reflected.
///
/// Worth is wanted of all elements alike, also where little of it comes to: rays carry it both ways, and half of them
/// are drawn by area (power_transfer.h).  By eight independent parts, on as many threads.
class Potential {
 public:
  /// By so many rays a stage, and those of its bounces.  The system, of constants with a target, outlives this.
  /// @param between  called before every bounce, from any thread: what it throws ends it, here as below
  Potential(
      const System& system, const SolverSettings& settings, const Run& run, std::uint64_t rays,
      std::function<void()> between = [] {});

  const ColumnMatrix& received() const { return received_; }  ///< q
  ColumnMatrix of_a_bounce();                                 ///< w
  ColumnMatrix of_a_walk();                                   ///< w
  std::uint64_t draws() const { return draws_; }

 private:
  ColumnMatrix solved(const ColumnMatrix& source);
  ColumnMatrix gathered(const ColumnMatrix& of);
  /// The mean over the parts of work(a sequence of its own, its rays).
  template <class Work>
  ColumnMatrix in_parts(const Work& work);

  const System& system_;
  const Run& run_;
  std::vector<std::unique_ptr<core::SampleSequence>> sequences_;
  std::uint64_t rays_, used_ = 0;
  std::function<void()> between_;
  std::atomic<std::uint64_t> draws_ = 0;
  ColumnMatrix source_, received_;  ///< s, q
};

/// How many rays the potential of a solver's round takes a stage: a sixteenth of the round's, but 16 an unknown at
/// least and 1 024 at most.
std::uint64_t potential_rays(const System& system, std::uint64_t rays_of_round);

/// Worth that leaves no power out: a tenth of its mean over the power goes to all, so that estimates have no more than
/// ten times the variance that they would have without, however wrong it is.
ColumnMatrix defensive(const ColumnMatrix& worth, const ColumnMatrix& power);

}  // namespace interflect::solvers
