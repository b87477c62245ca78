#pragma once

#include "scene/place.h"

namespace interflect::fem {

/// A point of an element from two numbers in [0, 1), and its weight: the ratio of areas around it, whose mean over the square is 1.
struct WeightedPoint {
  Vec3 position;
  double weight;
};

/// Triangles by the area-preserving map of [Turk 1990], weight 1; quads by the bilinear map, whose Jacobian is the weight.
WeightedPoint element_point(const scene::SurfacePatch& patch, double s, double t);

/// The four parts that the midpoints of its edges cut an element into.
std::array<scene::SurfacePatch, 4> quarters_of(const scene::SurfacePatch& patch);

}  // namespace interflect::fem
