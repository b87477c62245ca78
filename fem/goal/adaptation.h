#pragma once

#include <string>
#include <vector>

#include "core/spectrum.h"
#include "fem/goal/goal.h"

namespace interflect::fem {

/// What a solution shall be good for, and how good.
struct AdaptiveSettings {
  Goal goal;
  double target = 0.01;  ///< error of the goal over its value; 0: elements are left as they are, and it is estimated
  int most_passes = 30;
};

/// One mesh on the way.
struct AdaptivePass {
  Index elements;
  Index unknowns;       ///< functions of elements, by their degrees
  Spectrum value;       ///< of the goal
  Spectrum correction;  ///< estimate of what it lacks
  Spectrum error;       ///< estimated bound
  Spectrum quadrature;  ///< its part that form factors' own errors have
  double relative;      ///< the weighed error over the weighed value
  double seconds;       ///< since the start
};

enum class AdaptiveStop { met, form_factors, memory, passes, only_asked, asked_to_stop, out_of_time, no_light };
std::string describe(AdaptiveStop why);
/// Before its end, from outside.
inline bool was_stopped(AdaptiveStop why) {
  return why == AdaptiveStop::asked_to_stop || why == AdaptiveStop::out_of_time;
}

/// How elements came about that were made for a goal; there is a pass at least.
struct Adaptation {
  Goal goal;
  std::vector<AdaptivePass> passes;
  AdaptiveStop why;
};

}  // namespace interflect::fem
