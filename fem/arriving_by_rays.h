#pragma once

#include <span>
#include <vector>

#include "core/run.h"
#include "core/spectrum.h"
#include "fem/polynomial_field.h"
#include "fem/ray_transitions.h"

namespace interflect::fem {

/// sum_j F_ij v_j: what of a field that elements send arrives at each, where there is no matrix, by 64 rays of it.  Of
/// v between 0 and its largest, standard errors are at most a sixteenth of that.  Same bits for any threads.
/// @param sent  v, one an element
/// Test: tests/fem/sampled_radiosity.cpp
std::vector<Spectrum> arriving_by_rays(const RayTransitions& rays, std::span<const Spectrum> sent, const Run& run);

/// What arrives at elements of that which the highest degree adds to radiosity, B_h less that of the order below, in the
/// mean: its size by 64 rays of each, and what their spread leaves open.
std::vector<Spectrum> added_by_rays(const RayTransitions& rays, const PolynomialField& field, const Run& run);

}  // namespace interflect::fem
