#include "fem/form_factor/moments_by_degree.h"

#include <algorithm>

#include "core/error.h"

namespace interflect::fem {

MomentsByDegree::MomentsByDegree(const FormFactorContext& context, const ElementShapes& shapes)
    : functions_(plane_functions(context.order)), degrees_(context.degrees) {
  if (context.order < 1 || context.order > ElementBasis::highest_order)
    throw core::PreconditionError("MomentsByDegree: an order of 1 .. 3 expected");
  for (const int degree : degrees_)
    if (degree < 1 || degree > context.order)
      throw core::PreconditionError("MomentsByDegree: degrees of 1 .. order expected");
  const int lowest = degrees_.empty() ? context.order : 1;
  for (int order = lowest; order <= context.order; ++order) moments_.emplace_back(shapes, order, context.tolerance);
}

const MomentIntegrator& MomentsByDegree::of(Index i, Index j) const {
  if (degrees_.empty()) return moments_.back();
  const auto degree = [&](Index element) { return degrees_[static_cast<std::size_t>(element)]; };
  return moments_[static_cast<std::size_t>(std::max(degree(i), degree(j)) - 1)];
}

void MomentsByDegree::write(Index i, Index j, const PairMoments& block, double standard_error,
                            ExchangeSink& sink) const {
  for (Index a = 0; a < block.value.rows(); ++a)
    for (Index b = 0; b < block.value.cols(); ++b)
      sink.add(i * functions_ + a, j * functions_ + b, {block.value(a, b), standard_error, block.error});
}

}  // namespace interflect::fem
