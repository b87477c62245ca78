#pragma once

#include <span>

#include "geometry/triangulate.h"
#include "scene/scene.h"

namespace interflect::mesh {

/// Triangles cut at the midpoints of their longest edges, the longest of all first, until none is longer than
/// `max_edge` [m].
///
/// The edge that is cut is thus the longest of every triangle beside it: longest-edge bisection [Rivara 1984], whose
/// angles stay above half of the smallest given one.  A needle stays a needle; none is made.
///
/// Facets are neighbours where they share an edge, corner positions equal bit by bit.  An edge that more than two
/// facets share, or two that run along it in the same direction, is doubled: its copies are equally long and cut at the
/// same points, so that the mesh is conforming there too, and only its topology falls into parts.
///
/// A needle stays whole, however long it is, where its parts would come near the rounding of its coordinates and might
/// lose their area or turn over: far from the origin.  Its neighbours are cut without it; what then lies between them
/// is thinner than 1e-14 of the coordinates.
geometry::IndexedTriangles bisected(std::span<const scene::Facet> facets, double max_edge);

/// How many triangles `bisected` makes of one facet, exact up to ties between equally long edges; infinity beyond
/// numbers.
double bisected_count(const scene::Facet& facet, double max_edge);

}  // namespace interflect::mesh
