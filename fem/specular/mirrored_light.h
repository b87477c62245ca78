#pragma once

#include <vector>

#include "core/run.h"
#include "fem/radiosity.h"
#include "raycast/ray_caster.h"

namespace interflect::fem {

/// Irradiance of elements by lamps in mirrors and through bodies of glass, A S+ D, alone; what comes straight, or straight
/// through panes, is not in it.  It is in a solution's irradiance too: this tells how much it is of that.
struct MirroredLight {
  std::vector<Spectrum> irradiance;      ///< per element [W/m² | lx]
  std::vector<Spectrum> standard_error;  ///< of it
};

/// By rays from lamps, with density E cos / pi over their elements, that carry the same flux each (of all channels
/// together), and whose chains (specular_chains.h) end on elements:
///
///   H_j = (1 / A_j) (1 / n) sum_k Phi_k w_k [ray k is bent, and ends on j],   Phi_k = Phi E_k / sum_c E_k,c
///
/// Ray k is keyed by (seed, k): same bits for any number of threads.
/// @return  zeros where nothing bends light, or nothing shines
/// @throws core::Interrupted
MirroredLight mirrored_light(const scene::Scene& scene, const RadiositySolution& solution,
                             const raycast::RayCaster& rays, Run& run);

}  // namespace interflect::fem
