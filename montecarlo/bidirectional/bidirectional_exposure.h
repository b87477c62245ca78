#pragma once

#include "montecarlo/exposure.h"

namespace interflect::montecarlo {

/// By bidirectional path tracing, sweep by sweep (BidirectionalFilm).
MakeExposure bidirectional_exposure;

}  // namespace interflect::montecarlo
