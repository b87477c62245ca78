#pragma once

#include <vector>

#include "core/sobol.h"
#include "fem/form_factor/element_locator.h"
#include "fem/form_factor/element_shapes.h"
#include "fem/form_factor/method.h"
#include "fem/form_factor/uniform_map.h"

namespace interflect::fem {

/// Form factors of a row by rays: from points of a, each in a direction with density cos / pi about its normal,
///
///   F_ab = (rays that hit b first) / n,   K_ab = A_a F_ab
///
/// with the binomial standard error of counted_exchange.h.  Points are a scrambled and shifted Sobol sequence on a, so
/// that they are evenly spread; directions are independent, and so the truth is no worse than binomial and, for small
/// F, no better.  What hits a black back, a side without elements, or nothing, counts for nobody.  Pairs that
/// orientation proves dark get no entry; others do, hit or not.  By way of mirrors (FormFactorContext::by_mirrors) none
/// is dark, and an element may see itself.
///
/// Samples: n rays a row as asked for; or 1 024 again and again until the row's error,
///
///   (sum_b F_ab (1 - F_ab) / n + 1 / (n + 2)²)^1/2
///
/// the root of the sum of its entries' squared errors and of what no ray has found yet, is below the tolerance; 65 536
/// (an error of at most 0.004) at most.
///
/// The two views of a pair are weighted by n_a / A_a and n_b / A_b, which is 1 / variance where F is small.  Their
/// errors would not do: these are the smaller the fewer hits there were, and so would favour the view that is too low.
class HemisphereRays final : public FormFactorMethod {
 public:
  explicit HemisphereRays(const FormFactorContext& context);
  std::string name() const override { return "hemisphere-rays"; }
  Granularity granularity() const override { return Granularity::row; }
  PairCounts exchange(const ElementBlock& rows, const ElementBlock& columns, ExchangeSink& sink,
                      const Run& run) const override;

 private:
  class Row;

  FormFactorContext context_;
  std::uint64_t seed_;
  ElementShapes shapes_;
  ElementLocator locate_;
  std::vector<UniformMap> maps_;
  core::Sobol sequence_;
};

}  // namespace interflect::fem
