#pragma once

#include "fem/row_errors.h"

namespace interflect::fem {

/// What `RowAssembly::again` does again of rows that missed their tolerance.
enum class AgainPart : std::uint8_t {
  rows,    ///< whole ones
  entries  ///< those whose errors are not negligible
};

/// Seconds on one thread that `until_rows_meet` spends after its first pass, by a trial of about two seconds: a few
/// hundred entries each of random rows go through the passes that their rows would go through.  0 of methods that
/// cannot be asked for rows again.  For forecasts: a few pairs of a scene may take most of the time, and be missed.
/// Test: tests/fem/tolerance_trial.cpp
double seconds_of_later_passes(const MethodMaker& make, double tolerance, std::span<const scene::SurfacePatch> patches,
                               AgainPart part, const Run& run);

}  // namespace interflect::fem
