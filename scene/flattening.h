#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace interflect::scene {

/// What was done to a scene's polygons.
struct Flattened {
  std::size_t polygons = 0;  ///< that were not flat
  double furthest = 0;       ///< that a corner was moved [m]
};

/// Makes polygons flat that count as planar and are not, beyond rounding, as coordinates with a few digits leave them
/// once a room is turned: else their own facets would hide parts of them.
///
/// A corner goes where it goes for everything that has it, bit by bit, facets of meshes too, so that what was closed
/// stays closed and convex: to the nearest point of the planes of all polygons around it,
///
///   d = N^+ r,   N = their normals, r = their distances to it,
///
/// with planes about as they are (within some ten degrees) taken for one, since where two such meet is anywhere.
/// Planes are fitted anew and the step repeated while that helps; boxes and rooms, three planes a corner, need one.  A
/// polygon that stays bent, as in a finely tiled wall where every step spreads by one tile, is flattened by itself in
/// the end.
Flattened flatten_polygons(Scene& scene);

}  // namespace interflect::scene
