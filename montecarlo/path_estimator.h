#pragma once

#include "core/random.h"
#include "montecarlo/emitters.h"
#include "raycast/ray_caster.h"

namespace interflect::montecarlo {

/// A place that light arrives at, from the hemisphere of `normal` (unit).  Rays leave it as they leave a surface
/// (raycast::Ray), also where it is a point in free space: it may lie on a surface by chance.
struct Receiver {
  Vec3 position, normal;
};

/// One path, one unbiased estimate: the rendering equation of diffuse surfaces [Kajiya 1986] on irradiance,
///
///   H(x) = ∫ B(y) cos_x cos_y / (pi r²) V(x, y) dA_y,   B(y) = E(y) + rho(y) H(y),   L = B / pi,
///
/// by recursion on y, drawn from cos_x / pi (so that H is estimated by B(y) itself).  The emitted part E of B is found
/// by two techniques: that ray, and a point drawn on the emitters with pdf_area.  Under the balance heuristic [Veach
/// and Guibas 1995, eq. 11] both score the same function of (x, y), since f / (p_1 + p_2) does not know which of the
/// two drew y:
///
///   E(y) / (1 + pi pdf_area(y) / G),   G = cos_x cos_y / r²,   p_1 = G / pi [1/m²],
///
/// which is at most E: no singularity where walls and lights meet.  A path goes on from y with probability q = min(1,
/// max_c T_c) where T is the product of rho / q so far: never cut by length, and T_c <= 1 always.  Backs of one-sided
/// materials are black.
class PathEstimator {
 public:
  /// Both must outlive it.
  PathEstimator(const scene::Scene& scene, const raycast::RayCaster& caster);

  /// Irradiance H at a place [W/m² | lx].  Uses the dimensions of `numbers` from `block` on, three blocks a vertex.
  Spectrum irradiance(Receiver at, core::RandomNumbers& numbers, std::uint32_t block) const;

  /// Radiance L that comes to a point in free space along -direction, (E + rho H) / pi of what is seen there.
  Spectrum radiance(const Vec3& eye, const Vec3& direction, core::RandomNumbers& numbers, std::uint32_t block) const;

  const scene::Scene& scene() const { return scene_; }
  const Emitters& emitters() const { return emitters_; }

  /// What one vertex of a path can add to an irradiance at most: the largest exitance by each of the two techniques.
  Spectrum largest_score() const { return 2 * emitters_.max_exitance(); }

 private:
  struct Optics {
    Spectrum reflectance, exitance;
  };
  const Optics& optics(const scene::SurfacePoint& at) const {
    return optics_[2 * at.surface.value + (at.side == scene::Side::back)];
  }
  Spectrum from_emitters(const Receiver& at, double pick, double u, double v) const;
  Spectrum from_hit(const Receiver& at, const Vec3& direction, double cos_x, const scene::SurfacePoint& hit) const;

  const scene::Scene& scene_;
  const raycast::RayCaster& caster_;
  Emitters emitters_;
  std::vector<Optics> optics_;  ///< [2 * surface + (side is back)]
};

}  // namespace interflect::montecarlo
