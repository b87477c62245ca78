#pragma once

#include "fem/form_factor/hidden_pairs.h"

namespace interflect::fem {

/// K of doubtful pairs with what hides parts of them subtracted exactly (hidden_exchange.h): what `analytic` does with
/// all of them, and `hybrid` with the difficult ones.
class ExactOcclusion final : public PairOcclusion {
 public:
  /// As HiddenPairs.
  ExactOcclusion(const ElementShapes& shapes, const Blockers& blockers, double tolerance)
      : hidden_(shapes, blockers, tolerance) {}

  ExchangeEntry operator()(const DoubtfulPair& pair, PairCounts& counts) override;

 private:
  HiddenPairs<LambertOfParts> hidden_;
};

}  // namespace interflect::fem
