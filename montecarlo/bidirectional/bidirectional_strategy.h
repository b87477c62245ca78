#pragma once

namespace interflect::montecarlo {

/// How many vertices of a path are of the walk from the light, and of that from the eye: s and t, of s + t - 1 edges.
struct BidirectionalStrategy {
  int from_light, from_eye;
};

}  // namespace interflect::montecarlo
