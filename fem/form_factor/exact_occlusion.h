#pragma once

#include <vector>

#include "fem/form_factor/hidden_exchange.h"
#include "fem/form_factor/pair_method.h"

namespace interflect::fem {

/// K of doubtful pairs with what hides parts of them subtracted exactly (hidden_exchange.h): what `analytic` does with
/// all of them, and `hybrid` with the difficult ones.
class ExactOcclusion final : public PairOcclusion {
 public:
  /// @param tolerance  relative to the unoccluded K, or to what a sixteenth of a row would give each element, if that
  /// is
  ///                   more: so many of them add up to a sixteenth of the tolerance at most.  What is referred to
  ///                   outlives this.
  ExactOcclusion(const ElementShapes& shapes, const Blockers& blockers, double tolerance);

  ExchangeEntry operator()(const DoubtfulPair& pair, PairCounts& counts) override;

 private:
  void find_blockers(const DoubtfulPair& pair);
  HiddenIntegral hidden_part(const DoubtfulPair& pair);
  HiddenIntegral hidden_between(const ElementShape& a, const ElementShape& b, double tolerance);

  const ElementShapes& shapes_;
  const Blockers& blockers_;
  double tolerance_, least_of_row_;
  HiddenExchange hidden_;
  std::vector<std::uint32_t> found_;
  std::vector<const geometry::ConvexBlocker*> list_;
};

}  // namespace interflect::fem
