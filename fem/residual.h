#pragma once

#include "fem/radiosity.h"

namespace interflect::fem {

/// How well a solution satisfies the equation, at points:
///
///   r = E + rho T B_h - B_h,     B - B_h = (1 - rho T)^-1 r,
///   ||B - B_h||_2 <= ||r||_2 / (1 - max rho),     max |B - B_h| <= max |r| / (1 - max rho)
///
/// since neither norm of T exceeds 1: int k(x, y) dy <= 1 at every x, and k is symmetric, so that int k(x, y) dx <= 1
/// at every y too.  T B_h is found past whatever hides, in closed form of what is near, at 16 Gauss points of a quad
/// and of a triangle, and the largest |r| in corners and at three places of each edge as well, where it is up to four
/// times what it is at those: what is rough between them is not seen, so that the norms are estimates.  Bounds that
/// hold for certain are an Enclosure's.
struct ResidualNorms {
  std::vector<Spectrum> of_elements;  ///< root mean square of r over each
  Spectrum rms, largest;              ///< over all by area, ||r||_2 / sqrt(A); at any of the points
  /// Of B - B_h in the same norms; infinite where something absorbs nothing.
  Spectrum rms_bound, largest_bound;
};

/// @throws core::Interrupted
/// Test: tests/fem/residual.cpp
ResidualNorms residual_norms(const scene::Scene& scene, const RadiositySolution& solution, Run& run);

}  // namespace interflect::fem
