#pragma once

#include "montecarlo/exposure.h"

namespace interflect::montecarlo {

/// By light tracing, sweep by sweep: in each there are as many paths from lights as the picture has pixels, and any may
/// leave something in any pixel.
MakeExposure light_exposure;

}  // namespace interflect::montecarlo
