#pragma once

#include <optional>
#include <vector>

#include "scene/scene.h"

namespace interflect::mesh {

/// A convex planar quad cut along its bilinear coordinates into nu x nv quads, which are convex and planar too.
struct QuadGrid {
  std::array<Vec3, 4> corner;
  std::uint32_t nu, nv;  ///< cells along the sides 0-1 and 3-2, and along 1-2 and 0-3

  /// (1-s)(1-t) c0 + s (1-t) c1 + s t c2 + (1-s) t c3 with s = i / nu, t = j / nv.
  Vec3 point(std::uint32_t i, std::uint32_t j) const;
};

/// The grid of a surface that is one planar quad without holes and with no corner near 0 or 180 degrees; counts such
/// that the longer of two opposite sides is cut into edges of at most `max_edge` [m].  Nothing for other surfaces.
/// @throws core::PreconditionError  above 2^31 cells
std::optional<QuadGrid> quad_grid(const scene::Surface& surface, double max_edge);

/// How many cells that grid has, or would have: any number, infinity too.  Nothing where there is none.
std::optional<double> quad_grid_cells(const scene::Surface& surface, double max_edge);

}  // namespace interflect::mesh
