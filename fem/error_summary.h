#pragma once

#include "fem/radiosity.h"

namespace interflect::fem {

/// How wrong a solution is on the whole: area-weighted over the elements, in the weighted value of irradiance.
struct ErrorSummary {
  double mean_irradiance = 0;  ///< [W/m² | lx]
  /// How far that may be off, estimated: sum A bound / sum A, and 1.96 standard errors of what is sampled (SumNoise).
  double mean_error = 0;
  double relative_l2 = 0;  ///< sqrt( sum A bound² / sum A H² ): estimated, of discretisation, quadrature and solver
  double relative_noise_l2 = 0;  ///< the same of the standard errors of sampled visibility
};

/// Of the bounds of a solution that is not at its end, L2 as relative_l2: what is missing anyhow, and the rest.
struct ErrorShares {
  double of_unshot = 0, of_elements = 0;
};
/// @param missing  on irradiance, in all elements [W/m² | lx]
ErrorShares shares_of_error(const RadiositySolution& solution, const scene::Scene& scene, const Spectrum& missing);

ErrorSummary summarise_error(const RadiositySolution& solution, const scene::Scene& scene);

}  // namespace interflect::fem
