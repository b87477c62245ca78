#pragma once

#include "core/random.h"
#include "fem/specular/specular_chains.h"
#include "measure/measurement.h"
#include "mesh/element_mesh.h"

namespace interflect::fem {

/// What elements send to a point by all ways, straight or by mirrors and glass, by n rays from it:
///
///   H(x) = (1/n) sum_k w_k B_j(k),   directions with density cos / pi, j(k) where ray k ends and w_k its weight
///
/// Directions are stratified, n = side².  The rays are kept, so that any field on the elements may be gathered by them.
/// Test: tests/fem/specular/extended_radiosity.cpp
class RayGather {
 public:
  RayGather(const measure::PointIrradiance& at, const SpecularChains& chains, const mesh::ElementMesh& mesh,
            std::uint64_t seed, std::uint64_t key, int side);

  struct Met {
    std::size_t element;
    Spectrum weight;  ///< in what arrives, over n
  };
  /// Those that met an element.
  const std::vector<Met>& met() const { return met_; }
  std::uint64_t rays() const { return rays_; }
  Spectrum irradiance(std::span<const Spectrum> radiosity) const;
  /// Standard error of that, as if rays were independent: an upper bound where they are stratified.
  Spectrum noise(std::span<const Spectrum> radiosity) const;

 private:
  std::vector<Met> met_;
  std::uint64_t rays_;
};

}  // namespace interflect::fem
