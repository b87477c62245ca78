#pragma once

#include <cstddef>
#include <span>
#include <vector>

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
  /// Of z with the sign of a - b, over the measurements, in the weighted value.  Its noise is 1 / sqrt(measurements) where
  /// those are sampled one by one, and up to 1 where they share their samples: MeanAgreement knows.
  double mean_z = 0;
  std::size_t beyond = 0;  ///< comparisons above z_max, or not known: without finite errors
  bool agrees() const { return beyond == 0; }
};

/// How many comparisons that is.
std::size_t comparisons_of(const scene::Scene& scene, std::size_t measurements);

/// @param z_max  that chance alone hardly exceeds: sidak_z_max of all comparisons that are made, of other pairs too
/// @pre  as many of both
Agreement agreement(const scene::Scene& scene, std::span<const Estimate> a, std::span<const Estimate> b, double z_max);

/// One method's answers, and those of runs of other seeds, which may be small: independent of these and of each other.
struct Replicated {
  std::span<const Estimate> found;
  std::span<const std::vector<Estimate>> again;  ///< [replication][measurement]
};

/// A part that one loses everywhere, too small for any one z, over all measurements at once:
///
///   m_k = mean over measurements j of (a_jk - b_jk) / s_j,   s_j = sqrt(SE_a² + SE_b²) of `found`, weighted values,
///
/// in replication k of K.  However measurements of one run hang together, m_1 .. m_K do not, and by Student's
/// distribution their mean m is within
///
///   allowed = t(level, K - 1) sqrt(sum_k (m_k - m)² / (K (K - 1))) + mean of (bound_a + bound_b) / s
///
/// of 0 but for `level` of all cases, where no one loses anything.
/// Test: tests/validation/agreement.cpp
struct MeanAgreement {
  double mean = 0, allowed = 0;  ///< [noise of one measurement of `found`]
  bool judged = false;           ///< there are replications, and something to be compared
  bool agrees() const { return !judged || mean * mean <= allowed * allowed; }
};
/// @param level  probability of an error, of this comparison: sidak_level
/// @pre  as many measurements everywhere, and replications of both
MeanAgreement mean_agreement(const scene::Scene& scene, const Replicated& a, const Replicated& b, double level);

}  // namespace interflect::validation
