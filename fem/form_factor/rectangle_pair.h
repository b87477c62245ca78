#pragma once

#include <optional>
#include <span>

#include "core/vec.h"
#include "fem/form_factor/integral.h"

namespace interflect::fem {

/// K of two rectangles whose edges are parallel to the axes of one box, in closed form, at any offset.
///
/// In parallel planes at distance z, a's sides at x_i, y_j and b's at xi_k, eta_l:
///
///   K = sum_{ijkl} (-1)^{i+j+k+l} G(x_i - xi_k, y_j - eta_l, z),
///   G = 1/(2 pi) [ y p atan(y/p) + x q atan(x/q) - z²/2 ln(x² + y² + z²) ],   p² = x² + z²,  q² = y² + z²
///
/// In perpendicular planes that meet in a line along y, x_i and z_k the distances of a's and b's sides from it:
///
///   K = sum_{ijkl} (-1)^{i+j+k+l} G(y_j - eta_l, d_ik),   d² = x_i² + z_k²,
///   G = 1/(2 pi) [ y d atan(y/d) + (y² - d²)/4 ln(y² + d²) ]
///
/// Both are the double contour integral of polygon_pair.h, whose edges are all parallel or perpendicular here; pi is
/// inside.  A common edge or corner is no special case: y d atan(y/d) and d² ln d are 0 with d.
///
/// @param a, b  corners [m], counter-clockwise seen from the side that exchanges light, neither with a part behind
///          the other's plane
/// @return  K [m²] and an estimate of its error: 2^-53 times the sizes of what is summed, and how far the corners are
///          from a box's; nothing unless both have four corners, a box's to 1e-12 of their size and distance
///
/// Accuracy: about 1e-15 min(A) where they touch or are near; relative to K it is lost as (distance / diameter)^4.
/// Lengths times 2^k give the same digits.
///
/// Source: [Hamilton, Morgan 1952]; [Howell], catalogue of configuration factors, for offsets.
///
/// Test: tests/fem/closed_form_pairs.cpp
std::optional<Integral> rectangle_pair(std::span<const Vec3> a, std::span<const Vec3> b);

}  // namespace interflect::fem
