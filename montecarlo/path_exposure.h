#pragma once

#include "montecarlo/exposure.h"

namespace interflect::montecarlo {

/// By path tracing: each pixel's samples by themselves, independent or those of a sequence.
MakeExposure path_exposure;
/// The same without next-event estimation.
MakeExposure unidirectional_exposure;

}  // namespace interflect::montecarlo
