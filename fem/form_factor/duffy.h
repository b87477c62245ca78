#pragma once

#include <array>
#include <atomic>

#include "fem/form_factor/sampled_blocks.h"
#include "fem/polygon_pair_rule.h"

namespace interflect::fem {

/// Blocks of K by quadrature on both elements at once and nothing else: Galerkin's integrals of the plain kernel in
/// coordinates that take its singularity away (polygon_pair_rule.h), in ever more points until two rules agree.  It
/// shares no formula with the closed forms of the other methods, which is what it is for.  Pairs that something may
/// hide get rays, as in `gauss-lambert`.
///
/// Errors are estimated from the last two changes from rule to rule.  Of pairs that no rule brings to the tolerance, as
/// where elements meet at a few degrees or nearly touch all along, the first is told in a warning.
/// Test: tests/fem/space/duffy.cpp
class Duffy final : public SampledBlocks {
 public:
  explicit Duffy(const FormFactorContext& context);
  std::string name() const override { return "duffy"; }
  PairMoments block(Index i, Index j, const PairIntegral& K) const override;

 private:
  static constexpr std::array rule_points = {3, 5, 7, 9, 11, 13, 15, 17, 19};

  const PlaneBasis& basis(Index i) const override { return bases_[static_cast<std::size_t>(i)]; }
  PairMoments by_rules(Index i, Index j, double tolerance) const;

  Space space_;  ///< relative to `ElementShapes::origin`
  std::vector<PlaneBasis> bases_;
  std::vector<PolygonPairRule> rules_;
  mutable std::atomic<bool> told_ = false;  ///< of a pair that missed the tolerance
};

}  // namespace interflect::fem
