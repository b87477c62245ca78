#pragma once

#include <span>

#include "core/vec.h"

namespace interflect::fem {

/// Configuration factor from a differential element to a planar convex polygon, unoccluded (Lambert's formula).
///
///   F_{dA->P} = |1/(2 pi) sum_k theta_k  n . (r_k x e_k) / |r_k x e_k||,   r_k = p_k - x,  e_k = p_{k+1} - p_k,
///   theta_k = atan2(|r_k x e_k|, r_k . r_{k+1})
///
/// Identities: additive over a partition of P; 0 behind the horizon of (x, n), to which P is clipped first.  pi is
/// inside: irradiance from P is F times its radiosity B.  Which side of P is seen is the caller's question.
/// @param x, n     receiving point [m] and unit normal
/// @param polygon  corners [m], planar and convex, either orientation, 3 .. 8 of them
/// @return         in [0, 1], dimensionless; 0 where x lies in the polygon's plane
/// @throws core::PreconditionError  beyond 8 corners
/// Accuracy: relative about 1e-16 distance / (diameter cos): the terms are of the size of the angles, their sum is
/// smaller by cos diameter / distance.  (Taking e_k and not r_{k+1} in the cross product saves another factor distance
/// / diameter.)
/// Source: [Lambert 1760], for form factors by [Baum 1989] equation (6).  Test: tests/fem/point_to_polygon.cpp
double point_to_polygon(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon);

/// The same where the caller knows that no corner lies behind the horizon of (x, n): no clipping, any number of
/// corners.
double point_to_polygon_above_horizon(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon);

/// The same from far away, for the side that `polygon_normal` [unit] points to: one node at the centroid,
///
///   F = area cos cos / (pi r²)
///
/// Accuracy: relative error below 2 (diameter / distance)² / cos, so 1e-3 at 50 diameters unless it grazes; a tenth of
/// `point_to_polygon`'s cost.  Negative cosines count as 0.
double point_to_polygon_far(const Vec3& x, const Vec3& n, const Vec3& centroid, const Vec3& polygon_normal,
                            double area);

}  // namespace interflect::fem
