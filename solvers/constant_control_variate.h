#pragma once

#include "solvers/sampled_bounce.h"
#include "solvers/solver.h"

namespace interflect::solvers {

/// A bounce of what a power differs from a constant radiosity beta by [Bekaert 1999]: in a closed room a constant
/// arrives as it left, so that
///
///   R G^-1 K B = R beta + R G^-1 K (B - beta)
///
/// and samples bring the last alone.  beta, of each column, is what makes sum G |B - beta| least, to which their
/// variance is in proportion: the median of B by area.
class ConstantControlVariate final : public SampledBounce {
 public:
  /// @param of  how what is left is sampled.  The system outlives this.
  ConstantControlVariate(const System& system, const ColumnMatrix& power, const BounceFactory& of);
  void add(const core::SampleSequence& sequence, std::uint64_t first, std::uint64_t count, double weight,
           ColumnMatrix& reflected) const override;
  Eigen::RowVectorXd sizes() const override { return bounce_->sizes(); }
  const Eigen::RowVectorXd& constant() const { return beta_; }

 private:
  ColumnMatrix reflected_, left_;  ///< G R beta, and the power less G beta
  Eigen::RowVectorXd beta_;
  std::unique_ptr<SampledBounce> bounce_;
};

/// @throws core::InputError  where more than one in a thousand of the rays that leave unknowns arrives nowhere: the
/// room is open
void require_closed(const System& system, const std::string& solver, const Run& run);

}  // namespace interflect::solvers
