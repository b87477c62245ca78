#pragma once

#include <span>

#include "core/vec.h"

namespace interflect::geometry {

/// Area that two convex polygons of one plane have in common [m²], whichever way they run: `a` is clipped to the sides
/// of `b`. Polygons of different planes: the area of `a`'s part inside the prism that stands on `b`.
/// @param a, b  corners [m], convex; at most ConvexRing::capacity together
/// Accuracy: about 1e-15 of the product of their diameters, however far they are from the origin: computed about b's
/// first corner.
double overlap_area(std::span<const Vec3> a, std::span<const Vec3> b);

}  // namespace interflect::geometry
