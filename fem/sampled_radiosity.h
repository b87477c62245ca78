#pragma once

#include "fem/radiosity.h"

namespace interflect::fem {

/// Radiosity of constants, or of polynomials, by a solver that samples (solvers/solver.h, Needs::walks and what is more
/// but a target): rays alone, no form factors and no matrix, so that memory and time grow with elements and not with
/// their pairs.
///
/// Irradiance is b - e over rho; of elements that reflect nothing it is found by letting them reflect 1e-9 of it.  Its
/// noise is that of the solver's replications, which all share as far as the power of the whole room varies by more
/// than its parts do alone; an element that no ray found has the noise of what one ray brings.  Its error is estimated
/// as without a matrix (error_estimate.h).  Coefficients of polynomials have standard errors of their own, and the order
/// below is what is left without the highest degree: it is not solved for.  What closed rooms lose to seams of the geometry is in the energy balance.
/// Test: tests/fem/sampled_radiosity.cpp
/// @pre  require_sampled
/// @throws core::InputError   too little memory; what the solver cannot have
/// @throws core::Interrupted  before there are estimates
RadiositySolution sample_radiosity(const scene::Scene& scene, const RadiositySettings& settings, Run& run);

/// @throws core::InputError  settings that this cannot have
void require_sampled(const RadiositySettings& settings);

/// Elements, memory, and seconds by a short trial.
Forecast forecast_of_sampling(const scene::Scene& scene, const RadiositySettings& settings, const Run& run);

}  // namespace interflect::fem
