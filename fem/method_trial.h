#pragma once

#include "fem/form_factor/method.h"
#include "fem/point_view_factors.h"

namespace interflect::fem {

/// Seconds per pair of elements on one thread, by a short trial of a few hundredths of all pairs, or of about two
/// seconds if they take longer: random blocks of rows and columns (pair methods), a few random rows, or what a method
/// that does everything at once says of itself.  For forecasts: its answer varies with the machine's load.
double seconds_per_pair(const FormFactorMethod& method, std::span<const scene::SurfacePatch> patches, const Run& run);

/// The same of a point's view factors: the mean over four of the points at most.
double seconds_per_point(const PointViewFactors& factors, std::span<const measure::PointIrradiance> points);

}  // namespace interflect::fem
