#pragma once

#include "core/vec.h"

namespace interflect::montecarlo {

/// A place that light arrives at, from the hemisphere of `normal` (unit).  Rays leave it as they leave a surface
/// (raycast::Ray), also where it is a point in free space: it may lie on a surface by chance.
struct Receiver {
  Vec3 position, normal;
};

}  // namespace interflect::montecarlo
