#include "fem/row_sum_check.h"

#include <cmath>

#include "core/error.h"
#include "core/format.h"

namespace interflect::fem {

void require_row_sum(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches, std::size_t element,
                     double row_sum, double standard_error) {
  constexpr double above = 0.1, deviations = 4;
  if (!(row_sum > 1 + above + deviations * standard_error)) return;
  const scene::SurfacePatch& patch = patches[element];
  throw core::InputError(
      core::format("surface '%s'", scene.side_name(patch.surface, patch.side).c_str()),
      core::format("form factors of one of its elements add up to %.3g, and no more than 1 can be: do faces coincide "
                   "(interflect check), or are these another scene's?",
                   row_sum));
}

void require_row_sums(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                      std::span<const double> row_sum, const SymmetricOperator& K, Run& run) {
  solvers::ColumnMatrix variance = solvers::ColumnMatrix::Zero(K.size(), 1);
  if (K.has_errors()) K.apply_variances(solvers::ColumnMatrix::Ones(K.size(), 1), variance, run);
  for (std::size_t i = 0; i < row_sum.size(); ++i)
    require_row_sum(scene, patches, i, row_sum[i], std::sqrt(variance(static_cast<Index>(i), 0)) / K.gram()[i]);
}

}  // namespace interflect::fem
