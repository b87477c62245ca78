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
  std::size_t worst = 0;  ///< the measurement of the largest
  /// Of z with the sign of a - b, over the measurements, in the weighted value: a part that one loses everywhere pulls it
  /// away from 0 long before any z stands out.  Its noise is 1 / sqrt(measurements) where those are sampled one by one,
  /// and up to 1 where they share their samples: it is told, not judged.
  double mean_z = 0;
  std::size_t beyond = 0;  ///< comparisons above z_max, or not known: without finite errors
  bool agrees() const { return beyond == 0; }
};

/// How many comparisons that is.
std::size_t comparisons_of(const scene::Scene& scene, std::size_t measurements);

/// @param z_max  that chance alone hardly exceeds: sidak_z_max of all comparisons that are made, of other pairs too
/// @pre  as many of both
Agreement agreement(const scene::Scene& scene, std::span<const Estimate> a, std::span<const Estimate> b, double z_max);

}  // namespace interflect::validation
