#pragma once

#include <span>
#include <vector>

#include "core/run.h"
#include "raycast/ray_caster.h"
#include "scene/scene.h"

namespace interflect::fem {

/// F_a,env: what leaves element a and reaches no other, through openings, onto black backs or surfaces without
/// elements; sum_b F_ab + F_a,env = 1.
struct EnvironmentColumn {
  std::vector<double> factor;          ///< in [0, 1]
  std::vector<double> standard_error;  ///< never 0
};

/// By stratified cosine-distributed rays, k^4 an element in as many equal cells of place and direction, one in each:
///
///   F_a,env = 1/n sum_j w_j [ray j is lost],   s² = 1/n² (sum over pairs of neighbouring cells of (x_j - x_j')² + 4)
///
/// where w_j is the weight of ray j's place and x_j its term.  The pairs' differences hold those of their cells' means
/// too, so that s² is never too small in the mean, and far smaller than without strata [Cochran 1977, 5A.12, "collapsed
/// strata"].  Two rays are added, since the edge of an opening, or a small one, may lie between all rays.  Ray j of
/// element a is keyed by (seed, a, j).
/// @param patches          of every side of a surface all of its elements, or none
/// @param rays_an_element  rounded up to k^4 with an even k: 16, 256, 1 296, 4 096
/// @throws core::Interrupted
/// Test: tests/fem/environment_column.cpp
EnvironmentColumn cast_environment_column(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                                          const raycast::RayCaster& rays, std::uint64_t rays_an_element, Run& run);

/// Whether no ray at all was lost.
bool is_closed(const EnvironmentColumn& column);

}  // namespace interflect::fem
