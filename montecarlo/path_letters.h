#pragma once

#include "measure/path_classes.h"
#include "montecarlo/bsdf/bsdf.h"
#include "montecarlo/light/light.h"

namespace interflect::montecarlo {

inline measure::PathLetter letter_of(const Light& light) {
  if (light.is_infinite()) return light.is_delta_direction() ? measure::PathLetter::beam : measure::PathLetter::far;
  return light.is_delta_position() ? measure::PathLetter::point : measure::PathLetter::area;
}

/// Of what is not delta there.
inline measure::PathLetter letter_of(const Bsdf& bsdf) {
  return bsdf.glossy() ? measure::PathLetter::glossy : measure::PathLetter::diffuse;
}

/// Of a direction drawn there that is not straight on, which has no letter.
inline measure::PathLetter letter_of(const Bsdf& bsdf, const Scattered& drawn) {
  return drawn.delta ? measure::PathLetter::specular : letter_of(bsdf);
}

}  // namespace interflect::montecarlo
