#pragma once

#include <memory>
#include <vector>

#include "fem/operator/symmetric_operator.h"
#include "fem/radiosity.h"

namespace interflect::fem {

/// K of a scene's elements as settings ask for it, and what is known of it.
struct RadiosityOperator {
  std::unique_ptr<SymmetricOperator> K;
  std::unique_ptr<SymmetricOperator> blocks;  ///< of polynomials: of all unknowns, of which K has the first of elements
  PairCounts pairs;
  /// sum_b bound_ab / A_a of what was not sampled; empty unless `row_tolerance`, `closure` or stored factors need it.
  std::vector<double> row_bound;
  /// sum_b max(0, bound_ab - tolerance K_ab) / A_a: what entries may err by beyond `quadrature_tolerance`
  /// (BeyondTolerance); empty where the method heeds none.
  std::vector<double> beyond_tolerance;
  double largest_row_error =
      0;                      ///< max_a sum_b (bound_ab + 1.96 standard_error_ab) / A_a; 0 where `row_bound` is empty
  bool tolerance_met = true;  ///< `row_tolerance`, where there is one
};

/// What a method is made for, of those settings.
FormFactorContext form_factor_context(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                                      const raycast::RayCaster& rays, const RadiositySettings& settings,
                                      std::uint64_t seed);

/// Dense, or sparse where `drop_below` says so; by the method, until rows meet their tolerance if one is asked for, or
/// from `stored_factors`.
/// @throws core::InputError  unknown method, or one that needs more memory than `max_memory` on the way
/// @throws core::Interrupted
/// @param degrees  of polynomials on elements, where they differ (FormFactorContext); empty: the order, all
RadiosityOperator assemble_operator(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                                    const raycast::RayCaster& rays, const RadiositySettings& settings, Run& run,
                                    std::span<const int> degrees = {});

/// The same of polynomials, for elements of which some are those of `before`, whose pairs are taken from there.
/// @param same_as  per element: which of the elements before it is; -1: it is new, or of a higher degree than it was
/// @param degrees  per element, 1 .. settings.order
RadiosityOperator refined_operator(const RadiosityOperator& before, std::span<const Index> same_as,
                                   std::span<const int> degrees, const scene::Scene& scene,
                                   std::span<const scene::SurfacePatch> patches, const raycast::RayCaster& rays,
                                   const RadiositySettings& settings, Run& run);

}  // namespace interflect::fem
