#include "montecarlo/bsdf/metal_fresnel.h"

#include "core/fresnel.h"
#include "core/vec.h"

namespace interflect::montecarlo {

static Spectrum mean_of(const MetalFresnel& fresnel) {
  constexpr int n = 256;  // Simpson's rule
  Spectrum sum;
  for (int k = 0; k <= n; ++k) {
    const double c = static_cast<double>(k) / n, weight = k == 0 || k == n ? 1 : k % 2 == 1 ? 4 : 2;
    sum += fresnel(c) * (weight * 2 * c / (3 * n));
  }
  return sum;
}

MetalFresnel::MetalFresnel(const ComplexIndex& index) : by_(index), mean_(mean_of(*this)) {}
MetalFresnel::MetalFresnel(const Spectrum& at_normal) : by_(at_normal), mean_(mean_of(*this)) {}

Spectrum MetalFresnel::operator()(double cosine) const {
  if (const auto* index = std::get_if<ComplexIndex>(&by_)) {
    Spectrum F;
    for (int c = 0; c < Spectrum::capacity; ++c)  // channels that are not in use have no index
      F[c] = index->eta[c] > 0 ? core::fresnel(cosine, index->eta[c], index->k[c]).mean() : 0;
    return F;
  }
  const double left = 1 - cosine, edge = left * left * left * left * left;
  return std::get<Spectrum>(by_).map([&](double at_normal) { return at_normal + (1 - at_normal) * edge; });
}

}  // namespace interflect::montecarlo
