#pragma once

#include "geometry/polygon.h"

namespace interflect::mesh {

/// About how many triangles Delaunay refinement makes of the narrow places of a polygon, beyond those that its area
/// takes: of window frames, mullions, chamfers.
///
/// Where the outline is d from another of its edges, triangles are about as long as d: a strip of length l and width d
/// takes 1.2 l / d of them, between 0.85 and 1.7 since its sides are cut by halving (measured on
/// `triangulate_refined`).  Its area is counted already, so that per length of either side
///
///   max(0, 0.6 / d - d / (2 area_each))
///
/// is added: nothing where d is above half of the edge that area_each belongs to.
/// @param area_each  of triangles where there is room [m²]
double triangles_of_narrow_places(const geometry::PlanarPolygon& polygon, double area_each);

/// Whether a corner of the outline is sharper than a degree.  Delaunay refinement fills a corner of t radians with more
/// than 1 / t triangles: needles are better cut across.
bool has_needle(const geometry::PlanarPolygon& polygon);

}  // namespace interflect::mesh
