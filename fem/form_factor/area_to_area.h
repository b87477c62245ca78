#pragma once

#include <vector>

#include "core/sobol.h"
#include "fem/form_factor/blockers.h"
#include "fem/form_factor/element_shapes.h"
#include "fem/form_factor/method.h"
#include "fem/form_factor/uniform_map.h"

namespace interflect::fem {

/// Form factors by points on both elements, each pair of points a ray where something may lie between:
///
///   K_ij = A_i A_j E[cos_x cos_y V / (pi r²)]    x, y uniform on i and on j; far pairs
///   K_ij = A_i E[Omega_x cos_x V / pi]           x uniform on i, the smaller, y uniform in the solid angle Omega_x of
///                                                j; near ones
///
/// Near pairs need the second form: of two elements that touch, the variance of the first is infinite.  The second is
/// at most A_i.
///
/// Points are 16 independent randomisations (scramble and shift) of one Sobol sequence in four dimensions.  With the
/// means K_r of each,
///
///   K = mean of K_r,   s² = (15 / 13) sum (K_r - K)² / (16 * 15)
///
/// where 15 / 13, the variance of Student's t with 15 degrees of freedom, makes (K - truth) / s of variance 1.  Where
/// all rays of a pair agree, the error of a visibility of 1 / (n + 2) is added (visibility.h), since n rays that agree
/// prove no more.  Pairs that orientation proves dark are skipped; pairs that a shaft proves clear need no rays.
///
/// Samples: as many a pair as asked for, up to the next 16 * 2^m; or twice as many again and again until s <= tolerance
/// * K_unoccluded, 128 at least and 16 384 at most.
class AreaToArea final : public FormFactorMethod {
 public:
  explicit AreaToArea(const FormFactorContext& context);
  std::string name() const override { return "area-to-area"; }
  Granularity granularity() const override { return Granularity::pair; }
  PairCounts exchange(const ElementBlock& rows, const ElementBlock& columns, ExchangeSink& sink,
                      const Run& run) const override;

 private:
  static constexpr std::uint32_t randomisations = 16;
  class Sampling;

  ExchangeEntry estimate(Index i, Index j, Sampling& sampling, PairCounts& counts, const Run& run) const;

  FormFactorContext context_;
  std::uint64_t seed_;
  ElementShapes shapes_;
  Blockers blockers_;
  std::vector<UniformMap> maps_;
  std::vector<core::Sobol> sequences_;
};

}  // namespace interflect::fem
