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
  double mc_standard_error = 0;
  bool fem_agrees = false;  ///< |fem - expected| <= tolerance |expected|
  bool mc_agrees = false;   ///< the same, and 3 standard errors more
  bool passed() const { return fem_agrees && mc_agrees; }
};

/// The scene's list against the points of its sensors among `judged` (group = the sensor's name), in the weighted
/// value. A sensor without any point is a check that fails, with NaN for its values.
std::vector<ExpectedCheck> check_expected(const scene::Scene& scene, std::span<const Judged> judged);

}  // namespace interflect::validation
