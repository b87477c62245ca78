#pragma once

#include <cstddef>
#include <span>

#include "core/estimate.h"
#include "scene/scene.h"

namespace interflect::validation {

/// Two methods' answers to the same questions: |a - b| less what both claim of their bias, over the noise of both,
///
///   z = max(0, |a - b| - bound_a - bound_b) / sqrt(SE_a² + SE_b²),
///
/// in the weighted value and in every channel, of every measurement.
struct Agreement {
  std::size_t comparisons = 0;  ///< measurements times readings
  double largest_z = 0;
  std::size_t worst = 0;   ///< the measurement of the largest
  std::size_t beyond = 0;  ///< comparisons above z_max, or not known: without finite errors
  bool agrees() const { return beyond == 0; }
};

/// How many comparisons that is.
std::size_t comparisons_of(const scene::Scene& scene, std::size_t measurements);

/// @param z_max  that chance alone hardly exceeds: sidak_z_max of all comparisons that are made, of other pairs too
/// @pre  as many of both
Agreement agreement(const scene::Scene& scene, std::span<const Estimate> a, std::span<const Estimate> b, double z_max);

}  // namespace interflect::validation
