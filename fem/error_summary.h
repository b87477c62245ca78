#pragma once

#include "fem/radiosity.h"

namespace interflect::fem {

/// How wrong a solution is on the whole: area-weighted over the elements, in the weighted value of irradiance.
struct ErrorSummary {
  double mean_irradiance = 0;  ///< [W/m² | lx]
  /// How far that may be off, estimated: sum A bound / sum A, and 1.96 standard errors of at most
  /// shared + sqrt(2 sum A² own²) / sum A: K_ij = K_ji is one random number that two elements have, which doubles the
  /// variance at most, and what later bounces share is the same deviation once more.
  double mean_error = 0;
  double relative_l2 = 0;  ///< sqrt( sum A bound² / sum A H² ): estimated, of discretisation, quadrature and solver
  double relative_noise_l2 = 0;  ///< the same of the standard errors of sampled visibility
};

ErrorSummary summarise_error(const RadiositySolution& solution, const scene::Scene& scene);

}  // namespace interflect::fem
