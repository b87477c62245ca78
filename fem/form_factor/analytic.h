#pragma once

#include "fem/form_factor/pair_method.h"

namespace interflect::fem {

/// Form factors of pairs without rays and without noise: what hides parts of a pair is subtracted exactly, point by
/// point, and integrated along the shadows' edges (exact_occlusion.h) [Nishita, Nakamae 1985].  Same numbers whatever
/// the seed.
class Analytic final : public PairMethod {
 public:
  explicit Analytic(const FormFactorContext& context) : PairMethod(context) {}
  std::string name() const override { return "analytic"; }

 private:
  std::unique_ptr<PairWork> work() const override;
};

}  // namespace interflect::fem
