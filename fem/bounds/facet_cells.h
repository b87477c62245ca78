#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/polygon.h"

namespace interflect::fem {

/// A convex part of a facet that others touch along its edges alone: whatever is in front of one point of it is in
/// front of all.
struct FacetCell {
  std::uint32_t facet;
  Vec3 normal;          ///< unit, out of the facet's front
  geometry::Ring ring;  ///< counter-clockwise around it
};

/// Triangles cut wherever another stands on them, pierces them, or ends within them in their plane.  One is cut by the
/// line of such a contact, the longest first, and its parts by what touches them; contacts at single points do not
/// count.  Triangles no higher than the tolerance are left out.
/// @param tolerance  as near to a plane or an edge counts as on it
/// @param most       cells there may be; nothing where they are more
std::optional<std::vector<FacetCell>> facet_cells(std::span<const std::array<Vec3, 3>> triangles, double tolerance,
                                                  std::size_t most);

}  // namespace interflect::fem
