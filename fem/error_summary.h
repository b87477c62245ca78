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

ErrorSummary summarise_error(const RadiositySolution& solution, const scene::Scene& scene);

}  // namespace interflect::fem
