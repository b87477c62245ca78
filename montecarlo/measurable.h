#pragma once

#include "measure/measurement.h"
#include "scene/scene.h"

namespace interflect::montecarlo {

/// @throws core::InputError  for a patch without area, a flux through none, a direction that is not a unit vector, a
///                           camera or pixel that the scene does not have
void require_measurable(const scene::Scene& scene, const measure::Measurement& asked);

/// What an irradiance of 1 everywhere would measure: 1, the area of a flux [m²], 1 / pi for a pixel [1/sr].
double scale_of(const measure::Measurement& asked);

}  // namespace interflect::montecarlo
