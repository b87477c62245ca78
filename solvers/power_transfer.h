#pragma once

#include "solvers/power_draw.h"
#include "solvers/sampled_bounce.h"
#include "solvers/solver.h"
#include "solvers/transition_sampler.h"

namespace interflect::solvers {

/// A bounce of powers by rays [Neumann et al. 1994, 1995; Bekaert 1999]: of N rays each leaves an
/// unknown j drawn in proportion to its power P_j, and brings
///
///   rho_i P_j / (p_j N)        to the i where it arrives, p_j the probability of j       (rho_i P / N of one column)
///
/// Its mean is rho_i sum_j F_ji P_j, the power that one bounce of P reflects at i; of one column its variance, as
/// radiosity, is V = (rho_i P / G_i b_i - b_i²) / N.
///
/// Both ways, the same line carries light back from i to j as well.  It could have been drawn from either end, with the
/// densities q_j K_ij and q_i K_ij, q = p / G, of which it takes the sum (the balance heuristic): brings are
///
///   rho_i B_j / ((q_i + q_j) N)  to i,     rho_j B_i / ((q_i + q_j) N)  to j,     B = P / G
///
/// with the same means where K is symmetric, and of one column, where q = B / P, the variance
/// V = (rho_i² P / G_i² sum_j K_ij B_j² / (B_i + B_j) - b_i²) / N: half of the other where all send alike.
class PowerTransfer final : public SampledBounce {
 public:
  enum class Lines { one_way, both_ways };
  /// System and power outlive this.
  PowerTransfer(const System& system, const ColumnMatrix& power, Lines lines = Lines::one_way)
      : PowerTransfer(system, power, lines, power) {}
  /// Drawn in proportion to something else, as PowerDraw does: one way it must not be 0 where power is not.
  PowerTransfer(const System& system, const ColumnMatrix& power, Lines lines, const ColumnMatrix& drawn)
      : system_(system),
        power_(power),
        lines_(lines),
        draw_(drawn),
        sizes_(&drawn == &power ? draw_.sizes() : column_sizes(power)) {}

  void add(const core::SampleSequence& sequence, std::uint64_t first, std::uint64_t count, double weight,
           ColumnMatrix& reflected) const override;
  Eigen::RowVectorXd sizes() const override { return sizes_; }
  Eigen::RowVectorXd worths() const override { return draw_.sizes(); }

 private:
  /// What a sample that went from j to i brings.
  void exchange(Index j, Index i, double probability, double of_each, ColumnMatrix& reflected) const;
  void bring(Index j, Index i, double share, ColumnMatrix& reflected) const;

  const System& system_;
  const ColumnMatrix& power_;
  Lines lines_;
  PowerDraw draw_;
  Eigen::RowVectorXd sizes_;
};

}  // namespace interflect::solvers
