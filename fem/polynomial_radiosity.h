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

/// Solves for polynomials with the blocks of K: sets the solution's field, its radiosity and irradiance (means), its
/// coarse_radiosity (those of the order below) and the solver's report.
///
/// @param blocks  K of all unknowns, element after element
/// Test: tests/fem/space/polynomial_radiosity.cpp
PolynomialChange solve_polynomials(RadiositySolution& s, const SymmetricOperator& blocks,
                                   const RadiositySettings& settings, int channels, Run& run);

}  // namespace interflect::fem
