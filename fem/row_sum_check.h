#pragma once

#include <span>

#include "fem/operator/symmetric_operator.h"
#include "scene/scene.h"

namespace interflect::fem {

/// What leaves an element arrives once at most, sum_j F_ij <= 1, but for what entries err by: where a row adds up to
/// more than 1.1 beyond four of its standard errors, it is none of view factors, and a solve by it is worth nothing
/// (rho times the sum may exceed 1, so that light would grow from bounce to bounce).
/// @param row_sum  of K
/// @throws core::InputError  naming the surface
void require_row_sums(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                      std::span<const double> row_sum, const SymmetricOperator& K, Run& run);
/// The same of one element.
void require_row_sum(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches, std::size_t element,
                     double row_sum, double standard_error);

}  // namespace interflect::fem
