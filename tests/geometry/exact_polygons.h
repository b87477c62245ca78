#pragma once

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>

#include <span>
#include <vector>

#include "core/vec.h"

/// Polygons in the plane z = 1 as seen from the origin, and their booleans, exact.
namespace interflect::geometry::test {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactSet = CGAL::Polygon_set_2<Exact>;

/// The shadow of a ring in front of the origin, counter-clockwise.
inline CGAL::Polygon_2<Exact> projection(std::span<const Vec3> ring) {
  CGAL::Polygon_2<Exact> polygon;
  for (const Vec3& x : ring)
    polygon.push_back({Exact::FT(x.x()) / Exact::FT(x.z()), Exact::FT(x.y()) / Exact::FT(x.z())});
  if (polygon.orientation() == CGAL::CLOCKWISE) polygon.reverse_orientation();
  return polygon;
}

inline std::vector<CGAL::Polygon_with_holes_2<Exact>> parts_of(const ExactSet& set) {
  std::vector<CGAL::Polygon_with_holes_2<Exact>> parts;
  set.polygons_with_holes(std::back_inserter(parts));
  return parts;
}

}  // namespace interflect::geometry::test
