#pragma once

#include "core/sample_sequence.h"
#include "solvers/power_draw.h"
#include "solvers/solver.h"
#include "solvers/transition_sampler.h"

namespace interflect::solvers {

/// A bounce of powers by rays [Neumann et al. 1994, 1995; Bekaert 1999]: of N rays each leaves an
/// unknown j drawn in proportion to its power P_j, and brings
///
///   rho_i P_j / (p_j N)        to the i where it arrives, p_j the probability of j       (rho_i P / N of one column)
///
/// Its mean is rho_i sum_j F_ji P_j, the power that one bounce of P reflects at i; of one column its variance, as radiosity, is
/// V = (rho_i P / G_i b_i - b_i²) / N.
class PowerTransfer {
 public:
  PowerTransfer(const System& system, const ColumnMatrix& power);

  /// By rays first .. first + count of a sequence; brings are added, times `weight`.
  void add(const core::SampleSequence& sequence, std::uint64_t first, std::uint64_t count, double weight,
           ColumnMatrix& reflected) const;

 private:
  const System& system_;
  const ColumnMatrix& power_;
  PowerDraw draw_;
};

}  // namespace interflect::solvers
