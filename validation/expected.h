#pragma once

#include <span>
#include <string>
#include <vector>

#include "validation/judged.h"

namespace interflect::validation {

/// What a scene file expects of a sensor, and what both methods found.
struct ExpectedCheck {
  std::string sensor, statistic, source;
  double expected = 0;   ///< [W/m² | lx]
  double tolerance = 0;  ///< relative
  double fem = 0, mc = 0;
  double mc_standard_error = 0;  ///< of the mean; of the point that is the least or the largest
  bool fem_agrees = false;       ///< |fem - expected| <= tolerance |expected|
  bool mc_agrees = false;        ///< the noise's interval comes as near to it, see check_expected
  bool passed() const { return fem_agrees && mc_agrees; }
};

/// The scene's list against the points of its sensors among `judged` (group = the sensor's name), in the weighted
/// value. A sensor without any point is a check that fails, with NaN for its values.
///
/// Path tracing is given the room of its noise.  For a mean that is 3 standard errors.  The least of n noisy points is
/// biased downwards, and none of them need be the true least; but where all |M_j - H_j| <= z SE_j,
///
///   min_j (M_j - z SE_j) <= min_j H_j <= min_j (M_j + z SE_j),
///
/// so z is that which the largest of n normal numbers exceeds as rarely as one exceeds 3 (Sidak).  The same for the
/// largest.
std::vector<ExpectedCheck> check_expected(const scene::Scene& scene, std::span<const Judged> judged);

}  // namespace interflect::validation
