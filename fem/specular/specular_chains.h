#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/run.h"
#include "raycast/ray_caster.h"
#include "scene/scene.h"

namespace interflect::fem {

/// A smooth surface of the scene (smooth_surface.h); none: all light goes straight.
std::optional<scene::SurfaceId> any_smooth(const scene::Scene& scene);

/// Whether smooth surfaces treat all of the scene's channels alike.
bool are_smooth_ones_grey(const scene::Scene& scene);

/// Where the light comes from that arrives along a ray, by way of mirrors and glass: the chains S* of
///
///   B = E + rho T_S B,   T_S = D S* D,   F_ij = P(a cosine-distributed ray from i gets to j by any chain)
///
/// [Sillion and Puech 1989].  At each smooth surface chance says whether the ray is reflected, passes, or ends there,
/// by the largest channel of each part, so that its weight stays
///
///   prod_k part_k / max_c part_k,c:   1, exactly, where smooth surfaces are grey, or there is one channel;
///
/// rays then are counted as they are where nothing is smooth.  The numbers of a ray are keyed by the seed and by where
/// it starts and goes: the same ray, the same chain.
/// Test: tests/fem/specular/specular_chains.cpp
class SpecularChains {
 public:
  /// Both outlive this.
  SpecularChains(const scene::Scene& scene, const raycast::RayCaster& rays, std::uint64_t seed);

  struct End {
    std::optional<scene::SurfacePoint> at;  ///< nothing: outside; on a smooth surface: it ended there
    Spectrum weight{1};                     ///< of radiance there, in that which arrives
    bool bent = false;                      ///< somewhere: not straight, by panes alone
    /// It began and ended in media of the same index: else radiance has changed as its square, and A_i F_ij = A_j F_ji
    /// does not hold.
    bool same_medium = true;
  };
  End follow(const raycast::Ray& ray) const { return onward(ray, rays_.closest(ray)); }
  /// The same where it is known what the ray meets first.
  End onward(const raycast::Ray& ray, const std::optional<scene::SurfacePoint>& met) const;
  bool goes_on_at(const std::optional<scene::SurfacePoint>& met) const;

 private:
  const scene::Scene& scene_;
  const raycast::RayCaster& rays_;
  std::uint64_t seed_;
};

/// By rays from elements, chosen by area.
/// @throws core::InputError  where more of them than slip through edges of glass by rounding go from one medium into
///                           another: what stands inside glass has no reciprocal form factors
void require_outside_glass(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                           const raycast::RayCaster& rays, Run& run);

}  // namespace interflect::fem
