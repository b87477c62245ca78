#pragma once

#include "fem/radiosity.h"

namespace interflect::fem::test {

/// Of polynomials, past whatever hides exactly.
/// @param tolerance  relative, of an entry
inline RadiositySettings polynomial_settings(int order, double element_size, double tolerance = 1e-4) {
  RadiositySettings settings;
  settings.order = order;
  settings.form_factors = "analytic";
  settings.element_size = element_size;
  settings.quadrature_tolerance = tolerance;
  return settings;
}

}  // namespace interflect::fem::test
