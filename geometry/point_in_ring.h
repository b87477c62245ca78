#pragma once

#include <span>

#include "core/vec.h"

namespace interflect::geometry {

/// Whether a ring of the plane encloses a point that is on none of its edges: crossings of the ray towards +x, counted
/// by exact predicates.  An edge that the ring runs along twice does not count.
bool encloses(std::span<const Vec2> ring, const Vec2& p);

}  // namespace interflect::geometry
