#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "geometry/triangulate.h"

namespace interflect::geometry {
namespace {

struct VertexInfo {
  std::optional<Vec3> corner;  ///< nothing: made by refinement
  std::uint32_t index = 0;     ///< in the result
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase =
    CGAL::Delaunay_mesh_vertex_base_2<Kernel, CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, CGAL::Delaunay_mesh_face_base_2<Kernel>>,
    CGAL::Exact_predicates_tag>;
using Point = Triangulation::Point;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;

/// sin² of the smallest angle asked for: 20.7 degrees, below which refinement provably ends.
constexpr double aspect_bound = 0.125;

/// An orthonormal frame of the polygon's plane, along its longest edge: angles are those in space.
class Frame {
 public:
  explicit Frame(const Ring& ring) : origin_(ring[0]), v_(plane_of(ring).normal) {
    u_ = Vec3::Zero();
    for (std::size_t k = 0; k < ring.size(); ++k)
      if (const Vec3 edge = ring[(k + 1) % ring.size()] - ring[k]; edge.squaredNorm() > u_.squaredNorm()) u_ = edge;
    const Vec3 normal = v_;
    u_ = (u_ - normal.dot(u_) * normal).normalized();
    v_ = normal.cross(u_);
  }
  Point to_plane(const Vec3& r) const { return {u_.dot(r - origin_), v_.dot(r - origin_)}; }
  Vec3 to_space(const Point& p) const { return origin_ + p.x() * u_ + p.y() * v_; }

 private:
  Vec3 origin_, u_, v_;
};

void insert_ring(Triangulation& triangulation, const Frame& frame, const Ring& ring) {
  std::vector<Triangulation::Vertex_handle> corners;
  for (const Vec3& r : ring) {
    corners.push_back(triangulation.insert(frame.to_plane(r)));
    corners.back()->info().corner = r;
  }
  for (std::size_t k = 0; k < corners.size(); ++k)
    triangulation.insert_constraint(corners[k], corners[(k + 1) % corners.size()]);
}

/// A point well inside a ring: the middle of the largest of its triangles.
Vec3 point_inside(const Ring& ring) {
  const auto triangles = triangulate({ring, {}});
  const auto smaller = [](const TriangleCorners& s, const TriangleCorners& t) {
    return vector_area(s).norm() < vector_area(t).norm();
  };
  const TriangleCorners& best = *std::max_element(triangles.begin(), triangles.end(), smaller);
  return (best[0] + best[1] + best[2]) / 3;
}

IndexedTriangles collect(const Triangulation& triangulation, const Frame& frame) {
  IndexedTriangles result;
  for (const auto vertex : triangulation.finite_vertex_handles()) {
    vertex->info().index = static_cast<std::uint32_t>(result.vertices.size());
    const auto& corner = vertex->info().corner;
    result.vertices.push_back(corner ? *corner : frame.to_space(vertex->point()));
  }
  for (const auto face : triangulation.finite_face_handles())
    if (face->is_in_domain())
      result.triangles.push_back(
          {face->vertex(0)->info().index, face->vertex(1)->info().index, face->vertex(2)->info().index});
  return result;
}

}  // namespace

IndexedTriangles triangulate_refined(const PlanarPolygon& polygon, double max_edge) {
  if (!(max_edge > 0)) throw core::PreconditionError("triangulate_refined: the longest edge must be positive");
  require_valid(polygon);
  const Frame frame(polygon.outer);
  Triangulation triangulation;
  insert_ring(triangulation, frame, polygon.outer);
  std::vector<Point> holes;
  for (const Ring& hole : polygon.holes) {
    insert_ring(triangulation, frame, hole);
    holes.push_back(frame.to_plane(point_inside(hole)));
  }
  CGAL::Delaunay_mesher_2<Triangulation, Criteria> mesher(triangulation, Criteria(aspect_bound, max_edge));
  mesher.set_seeds(holes.begin(), holes.end(), false);
  mesher.refine_mesh();
  return collect(triangulation, frame);
}

}  // namespace interflect::geometry
