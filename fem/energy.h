#pragma once

#include "fem/radiosity.h"
#include "raycast/ray_caster.h"

namespace interflect::fem {

/// Where rays that leave the elements end up.
struct LostRays {
  Spectrum escaped, on_backs,
      in_mirrors;  ///< flux by rays [W | lm]; the last in smooth surfaces, where it was absorbed
  Spectrum escaped_error, on_backs_error, in_mirrors_error;

  Spectrum all() const { return escaped + on_backs + in_mirrors; }
  std::uint64_t rays = 0, lost = 0;
};

/// Cosine-distributed rays from the elements: half of them by flux A_i B_i (channels weighed as the scene weighs them),
/// half by area, so that dark openings are found too; each carries A_i B_i over its probability.  Ray k is keyed by
/// (seed, k).
/// @param radiosity  per element; all 0: by area alone
LostRays cast_lost_rays(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                        std::span<const Spectrum> radiosity, const raycast::RayCaster& rays, Run& run);

/// The balance of a solution whose radiosity, irradiance and row sums are there; without row sums rays alone say what
/// is lost, and the residual is the noise of both.
EnergyBalance energy_balance(const RadiositySolution& solution, const LostRays& lost);

}  // namespace interflect::fem
