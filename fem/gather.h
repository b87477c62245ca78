#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fem/form_factor/blockers.h"
#include "fem/form_factor/element_clusters.h"
#include "measure/measurement.h"
#include "raycast/ray_caster.h"

namespace interflect::fem {

/// What an element sends to a point: irradiance is the sum of `factor` times radiosity.
struct GatheredElement {
  Index element;
  double factor;          ///< F_{dA->j} V(x, j), in [0, 1]; pi is inside
  double standard_error;  ///< of `factor`, from sampled visibility; 0 where the element was proved visible
};

struct Gathered {
  std::vector<GatheredElement> elements;  ///< ascending, those with a factor or an error above 0
  std::uint64_t rays = 0;
};

/// The iterated irradiance at points [Sloan 1976], the "final gather":
///
///   H_1(x, n) = sum_j F_{dA(x,n)->j} V(x, j) B_j  [W/m² | lx]
///
/// Lambert's formula on the part of element j above the horizon of (x, n) and on the side it is seen from; visibility 1
/// where a shaft proves it, else from stratified rays weighted by cos cos / r².  A near element is cut into quarters
/// first, until its parts are smaller than their distance, so that one part's rays count about equally.  Rays are given
/// in proportion to what an element may contribute.
class Gather {
 public:
  /// All of it outlives the gather.  @param rays_per_point  to be shared by the elements that need them; each gets 4 at
  /// least
  Gather(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches, const raycast::RayCaster& rays,
         std::uint64_t seed, int rays_per_point = 4096);

  /// @param key         of the measurement: with the seed and the element, of its random numbers
  /// @param importance  per element, >= 0: its radiosity as one number, to give rays by
  Gathered operator()(const measure::PointIrradiance& at, std::uint64_t key, std::span<const double> importance) const;

 private:
  struct Receiver;
  struct Rays;
  struct Part;
  struct Unproved;
  void add_part(const Receiver& at, const scene::SurfacePatch& part, std::uint32_t path, int depth,
                Unproved& element) const;
  std::vector<Unproved> unproved_elements(const Receiver& at, Gathered& out) const;
  void cast(const Receiver& at, const Part& part, Index element, int side, Rays& rays) const;
  GatheredElement sampled(const Receiver& at, const Unproved& element, double rays_per_factor,
                          std::uint64_t& rays_cast) const;

  std::span<const scene::SurfacePatch> patches_;
  const raycast::RayCaster& rays_;
  std::uint64_t seed_;
  int rays_per_point_;
  ElementShapes shapes_;
  std::vector<ElementCluster> clusters_;
  Blockers blockers_;
};

/// sum_j factor_j B_j.
Spectrum irradiance(const Gathered& gathered, std::span<const Spectrum> radiosity);

/// sqrt(sum_j (standard_error_j B_j)²): independent visibilities.
Spectrum irradiance_noise(const Gathered& gathered, std::span<const Spectrum> radiosity);

}  // namespace interflect::fem
