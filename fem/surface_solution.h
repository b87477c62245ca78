#pragma once

#include "fem/specular/mirrored_light.h"
#include "measure/surface_solution.h"

namespace interflect::fem {

/// What elements of constants reflect; cells are elements.  The error bound is that of the element's mean, and what
/// radiosity varies by inside the element.
/// @param mirrored  of that solution
/// Test: tests/fem/specular/extended_radiosity.cpp
measure::SurfaceSolution as_surface_solution(const RadiositySolution& solution, const MirroredLight& mirrored);

}  // namespace interflect::fem
