#pragma once

#include <optional>

#include "measure/surface_solution.h"
#include "montecarlo/path_estimator.h"

namespace interflect::montecarlo {

/// The second pass over a solution for what is diffuse [Sillion and Puech 1989]: every path of light is found once, by
/// the one pass or the other.  With X = (S|G)* and a solution of A(D|S)*,
///
///   no gather:    A(D|S)* D X E             by the solution where the walk from the eye first meets a diffuse surface,
///                 L X E, L.*G.*D X E        by path tracing;
///   one gather:   A(D|S)* D X D X E         by the solution one diffuse bounce later: shadows are those of rays,
///                 A S+ D X E                by what it knows of light that mirrors and glass throw onto the first one,
///                 L X E, L D X E,           by path tracing.
///                 L X G X D X E, L.*G.*D X D X E
///
/// The solution is asked for rho H = B - E: emitted light is path tracing's, which aims at lights.  What is measured
/// (a patch, a point) reflects everything diffusely and counts as E: a patch without a gather is already one of a
/// pixel with it.
class TwoPassEstimator {
 public:
  /// Scene and caster outlive it.
  TwoPassEstimator(const scene::Scene& scene, const raycast::RayCaster& caster, int gathers);

  static measure::PathClasses traced(int gathers);
  const PathEstimator& paths() const { return paths_; }

  /// Where the solution is asked, and what the answer counts in what is measured.
  struct Asked {
    scene::SurfacePoint at;
    Spectrum weight;
  };
  struct Walked {
    std::optional<Asked> reflected;  ///< at the end; nothing where the walk ends before
    std::optional<Asked> mirrored;   ///< on the way
  };
  /// Of the radiance that comes along a ray.  Uses the dimensions of `numbers` from `block` on, four blocks a vertex.
  Walked radiance(const raycast::Ray& ray, core::RandomNumbers& numbers, std::uint32_t block) const;
  /// Of the irradiance at a place.
  Walked irradiance(const Receiver& at, core::RandomNumbers& numbers, std::uint32_t block) const;

 private:
  Walked arriving(raycast::Ray ray, Spectrum throughput, core::RandomNumbers& numbers, std::uint32_t block) const;

  const raycast::RayCaster& caster_;
  int gathers_;
  SurfaceOptics optics_;
  PathEstimator paths_;
};

/// What a solution says where it was asked.
struct Answered {
  Spectrum value, bound;             ///< what it may err by, but for the noise of what is reflected
  Spectrum own_noise, shared_noise;  ///< of that: the standard errors of measure::SurfaceSolution
  std::uint32_t cell = ~0u;
};
Answered answered(const measure::SurfaceSolution& solution, const TwoPassEstimator::Walked& walked);

}  // namespace interflect::montecarlo
