#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/vec.h"

namespace interflect::fem {

/// A triangle or a convex quad.
struct CellPart {
  std::array<Vec3, 4> corner;
  std::size_t corners;
  std::span<const Vec3> ring() const { return {corner.data(), corners}; }
};

/// A triangle or a convex quad in four parts: its quarters, or, where it is long, what halving across its length twice
/// leaves, a needle's tip being a triangle and the rest of it quads.
///
/// The quarters of a sliver are as long for their width as it was: to come down to a distance d that lies between its
/// width and its length L takes (L / d)² of them, and L / d parts across.
std::array<CellPart, 4> four_parts(std::span<const Vec3> ring);

}  // namespace interflect::fem
