#pragma once

#include "mesh/element_mesh.h"

namespace interflect::mesh {

/// Every surface cut until no edge is longer than `max_edge` [m].
///
/// A surface that is one planar quad becomes a grid of quads; another planar polygon is meshed by Delaunay refinement; facets of
/// mesh files are bisected at their longest edge, with their neighbours, so that the surface stays conforming [Rivara 1984].
ElementMesh uniform(const scene::Scene& scene, double max_edge);

/// Every element cut into four, at the midpoints of its edges: children 4i .. 4i+3 of element i, in order.
ElementMesh quartered(const ElementMesh& mesh);

/// About how many elements `uniform` makes, without making them: for forecasts.
double predicted_elements(const scene::Scene& scene, double max_edge);

/// Edge length for about `elements` elements, to two digits [m].
double edge_for(const scene::Scene& scene, double elements);

}  // namespace interflect::mesh
