#pragma once

#include <vector>

#include "fem/operator/symmetric_operator.h"
#include "fem/radiosity.h"

namespace interflect::fem {

/// What the highest degree adds to a solution.
struct PolynomialChange {
  bool converged;                         ///< both solves
  std::vector<Spectrum> mean_irradiance;  ///< |h_p - h_{p-1}| of elements' means
  std::vector<Spectrum> variation;        ///< of irradiance: root mean square of functions of the highest degree
};

/// Solves for polynomials with the blocks of K, or at nodes where settings say so: sets the solution's field, its
/// radiosity and irradiance (means), its coarse_radiosity (those of the order below) and the solver's report.
///
/// @param blocks  K of all unknowns, element after element
/// @param degree  of polynomials on elements, 1 .. settings.order; empty: the order, all
/// Test: tests/fem/space/polynomial_radiosity.cpp
PolynomialChange solve_polynomials(RadiositySolution& s, const scene::Scene& scene, const SymmetricOperator& blocks,
                                   std::span<const int> degree, const RadiositySettings& settings, Run& run);

}  // namespace interflect::fem
