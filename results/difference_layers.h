#pragma once

#include "core/image.h"

namespace interflect::results {

/// A picture, and the standard error of each of its numbers.
struct PictureWithError {
  const core::Image& values;
  const core::Image& standard_error;
};

/// What two pictures of independent errors differ by, number by number: nothing is averaged, clipped or left out.
///
///   NAME = a - b,   NAME.error = sqrt(error_a² + error_b²),   NAME.z = NAME / NAME.error
///
/// z is 0 where both are the same, whatever their errors, and where an error is infinite; it is infinite where they
/// differ and neither states an error.
/// @return  the channels of a, then those with .error, then those with .z
/// @throws core::PreconditionError  if they are not of one size and the same channels
/// Test: tests/results/difference_layers.cpp
core::Image difference_layers(const PictureWithError& a, const PictureWithError& b);

}  // namespace interflect::results
