#pragma once

#include <variant>

#include "core/spectrum.h"

namespace interflect::montecarlo {

/// What a metal reflects by angle: by its complex index, or by what it reflects at normal incidence [Schlick 1994].
class MetalFresnel {
 public:
  struct ComplexIndex {
    Spectrum eta, k;
  };
  explicit MetalFresnel(const ComplexIndex& index);
  explicit MetalFresnel(const Spectrum& at_normal);
  Spectrum operator()(double cosine) const;
  const Spectrum& mean() const { return mean_; }  ///< of light from all directions alike

 private:
  std::variant<ComplexIndex, Spectrum> by_;
  Spectrum mean_;
};

}  // namespace interflect::montecarlo
