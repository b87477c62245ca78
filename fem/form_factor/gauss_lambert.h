#pragma once

#include "fem/form_factor/pair_method.h"
#include "fem/form_factor/pair_visibility.h"

namespace interflect::fem {

/// Form factors of pairs whose visibility, where it is in doubt, is sampled by rays; that gives an entry its standard
/// error.
class GaussLambert final : public PairMethod {
 public:
  explicit GaussLambert(const FormFactorContext& context);
  std::string name() const override { return "gauss-lambert"; }

 private:
  class Rays;
  std::unique_ptr<PairWork> work() const override;

  PairVisibility visibility_;
};

}  // namespace interflect::fem
