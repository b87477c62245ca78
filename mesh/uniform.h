#pragma once

#include "mesh/element_mesh.h"

namespace interflect::mesh {

/// Whether a side of a surface of that material gets elements.
using HasElements = bool (*)(const scene::Material& material, scene::Side side);
inline bool is_active(const scene::Material& material, scene::Side side) { return material.active(side); }

/// Every surface cut until no edge is longer than `max_edge` [m] (save in needles that rounding forbids to cut:
/// bisection.h), into elements that can be cut into four.
///
/// A surface that is one planar quad becomes a grid of quads; another planar polygon is meshed by Delaunay refinement;
/// facets of mesh files, and of polygons with a corner below a degree, are bisected at their longest edge, with their
/// neighbours, so that the surface stays conforming [Rivara 1984].
/// @throws core::InputError  in one line where max_edge is no positive length, where it makes more than 2^31 elements,
///                           and where an element is too thin for its coordinates, naming its surface and place
ElementMesh uniform(const scene::Scene& scene, double max_edge, HasElements has_elements = is_active);

/// As few elements as there can be: a surface that is a triangle or a convex quad is one, another planar polygon its
/// triangulation, a mesh its facets.  None is cut for its shape: needles stay needles.
/// @throws core::InputError  as `uniform`, where an element is too thin for its coordinates
ElementMesh whole_faces(const scene::Scene& scene);

/// Whole faces, those with an edge longer than `max_edge` [m] cut into four again and again: few elements, whose
/// corners may hang, and more than `uniform` makes of a needle.
/// @throws core::InputError  as `uniform`
ElementMesh coarse(const scene::Scene& scene, double max_edge);

/// Every element cut into four, at the midpoints of its edges: children 4i .. 4i+3 of element i, in order.
ElementMesh quartered(const ElementMesh& mesh);

/// Some elements cut into four, in the place of the whole ones: their neighbours are left as they are, so that corners
/// may hang on edges.
struct PartlyQuartered {
  ElementMesh mesh;
  std::vector<std::size_t> parent;  ///< of each element: the one before that it is, or is a quarter of
};
/// @param which  per element
PartlyQuartered quartered(const ElementMesh& mesh, const std::vector<bool>& which);

/// About how many elements `uniform` makes, or would make, without making them: for forecasts.  Any number, infinity
/// too.
double predicted_elements(const scene::Scene& scene, double max_edge, HasElements has_elements = is_active);

/// Edge length for about `elements` elements, to two digits [m].
double edge_for(const scene::Scene& scene, double elements, HasElements has_elements = is_active);

/// Edge length with which this area alone, however it is cut up already, would be about `elements` triangles, to two
/// digits [m].
double edge_for_area(double area, double elements);

/// Area of all sides that get elements [m²].
double meshed_area(const scene::Scene& scene, HasElements has_elements = is_active);

}  // namespace interflect::mesh
