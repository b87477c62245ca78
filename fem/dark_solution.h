#pragma once

#include "fem/radiosity.h"

namespace interflect::fem {

/// Whether nothing emits that elements are made of.
bool is_dark(const scene::Scene& scene);

/// What a solve of a dark scene finds, B = H = 0 without error, at once: no form factors are made (there are no row sums
/// then) and nothing is solved; elements for a goal are as they
/// would be without one, and one pass is told of.
/// @pre  is_dark
/// Test: tests/fem/dark_solution.cpp
/// @throws core::InputError  no elements, or too little memory for what they carry themselves
RadiositySolution dark_solution(const scene::Scene& scene, const RadiositySettings& settings, Run& run);

/// Elements, memory, and no time.
Forecast forecast_of_darkness(const scene::Scene& scene, const RadiositySettings& settings);

}  // namespace interflect::fem
