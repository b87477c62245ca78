#pragma once

#include "core/spectrum.h"

namespace interflect {

/// Proved bounds of a number, per channel, in its unit.
struct Interval {
  Spectrum lower, upper;
};

}  // namespace interflect
