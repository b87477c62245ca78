#include "fem/form_factor/moments_by_degree.h"

#include "core/error.h"

namespace interflect::fem {

MomentsByDegree::MomentsByDegree(const FormFactorContext& context, const ElementShapes& shapes) : context_(context) {
  if (context.order < 1 || context.order > ElementBasis::highest_order)
    throw core::PreconditionError("MomentsByDegree: an order of 1 .. 3 expected");
  for (const int degree : context.degrees)
    if (degree < 1 || degree > context.order)
      throw core::PreconditionError("MomentsByDegree: degrees of 1 .. order expected");
  const int lowest = context.degrees.empty() ? context.order : 1;
  for (int order = lowest; order <= context.order; ++order) moments_.emplace_back(shapes, order, context.tolerance);
}

const MomentIntegrator& MomentsByDegree::of(Index i, Index j) const {
  return moments_[static_cast<std::size_t>(pair_degree(context_, i, j) - moments_.front().order())];
}

}  // namespace interflect::fem
