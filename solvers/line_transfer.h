#pragma once

#include "solvers/sampled_bounce.h"
#include "solvers/solver.h"
#include "solvers/transition_sampler.h"

namespace interflect::solvers {

/// A bounce of powers by lines through everything [Neumann 1995; Sbert 1997]: of N lines each brings, for every
/// exchange between i and j along it, which it expects 2 K_ij / M of, M = 4 pi R²,
///
///   rho_i B_j M / (2 N G_i)  to i's radiosity,     rho_j B_i M / (2 N G_j)  to j's,     B = P / G
///
/// wherever light comes from.  In a convex room, one exchange a line, the variance of a line is, as radiosity,
/// V = rho_i² M / (2 G_i²) sum_j K_ij B_j² - b_i².
class LineTransfer final : public SampledBounce {
 public:
  /// All outlive this.  Walks have lines (require_lines).
  LineTransfer(const System& system, const ColumnMatrix& power);
  void add(const core::SampleSequence& sequence, std::uint64_t first, std::uint64_t count, double weight,
           ColumnMatrix& reflected) const override;
  Eigen::RowVectorXd sizes() const override { return power_.cwiseAbs().colwise().sum(); }

 private:
  const System& system_;
  const ColumnMatrix& power_;
  const LineExchanges& lines_;
};

}  // namespace interflect::solvers
