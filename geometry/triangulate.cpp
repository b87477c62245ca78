#include "geometry/triangulate.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "geometry/plane_coordinates.h"
#include "geometry/point_in_ring.h"

namespace interflect::geometry {
namespace {

struct FaceInfo {
  int depth = -1;  ///< rings crossed on the way in from infinity: odd inside the polygon
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Vec3, Kernel>;  // its corner in space
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Face = Triangulation::Face_handle;
using Vertex = Triangulation::Vertex_handle;

void insert_ring(Triangulation& triangulation, const AxisShadow& shadow, std::span<const Vec3> ring) {
  std::vector<Vertex> corners;
  for (const Vec3& r : ring) {
    corners.push_back(triangulation.insert(Triangulation::Point(shadow.x(r), shadow.y(r)),
                                           corners.empty() ? Face() : corners.back()->face()));
    corners.back()->info() = r;
  }
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (const Vertex next = corners[(k + 1) % corners.size()]; next != corners[k])
      triangulation.insert_constraint(corners[k], next);
}

TriangleCorners corners_of(const Face& face) {
  return {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
}

/// Marks how many rings lie between each face and infinity: a flood that is held back by constraints, level by level.
void mark_depths(Triangulation& triangulation) {
  std::vector<Face> level{triangulation.infinite_face()}, beyond;
  for (int depth = 0; !level.empty(); ++depth, level.swap(beyond), beyond.clear()) {
    while (!level.empty()) {
      const Face face = level.back();
      level.pop_back();
      if (face->info().depth >= 0) continue;
      face->info().depth = depth;
      for (int side = 0; side < 3; ++side)
        if (const Face neighbour = face->neighbor(side); neighbour->info().depth < 0)
          (triangulation.is_constrained({face, side}) ? beyond : level).push_back(neighbour);
    }
  }
}

Vec2 middle_of(const Face& face) {
  const auto middle = CGAL::centroid(face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point());
  return {middle.x(), middle.y()};
}

}  // namespace

std::vector<TriangleCorners> triangulate(const PlanarPolygon& polygon) {
  require_valid(polygon);
  if (polygon.outer.size() == 3 && polygon.holes.empty())
    return {{polygon.outer[0], polygon.outer[1], polygon.outer[2]}};
  const AxisShadow shadow(vector_area(polygon.outer));
  Triangulation triangulation;
  insert_ring(triangulation, shadow, polygon.outer);
  for (const Ring& hole : polygon.holes) insert_ring(triangulation, shadow, hole);
  mark_depths(triangulation);
  std::vector<TriangleCorners> triangles;
  for (const Face face : triangulation.finite_face_handles())
    if (face->info().depth % 2 == 1) triangles.push_back(corners_of(face));
  return triangles;
}

std::vector<TriangleCorners> triangulate_face(std::span<const Vec3> ring) {
  if (ring.size() < 3) throw Defect("a face has at least three corners");
  for (const Vec3& r : ring)
    if (!r.allFinite()) throw Defect("a corner is not finite");
  const AxisShadow shadow(vector_area(ring));
  Triangulation triangulation;
  try {
    insert_ring(triangulation, shadow, ring);
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    throw Defect("the face crosses itself");
  }
  std::vector<Vec2> outline;
  for (const Vec3& r : ring) outline.push_back(shadow(r));
  std::vector<TriangleCorners> triangles;
  for (const Face face : triangulation.finite_face_handles())
    if (encloses(outline, middle_of(face))) triangles.push_back(corners_of(face));
  if (triangles.empty()) throw Defect("the face has no area");
  return triangles;
}

}  // namespace interflect::geometry
