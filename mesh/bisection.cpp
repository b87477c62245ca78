#include "mesh/bisection.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>

#include "core/disjoint_sets.h"
#include "core/error.h"

namespace interflect::mesh {
namespace {

using TriangleMesh = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;
using Edge = TriangleMesh::EdgeHandle;

OpenMesh::Vec3d to_openmesh(const Vec3& x) { return {x.x(), x.y(), x.z()}; }
Vec3 from_openmesh(const OpenMesh::Vec3d& x) { return {x[0], x[1], x[2]}; }

/// Positions equal bit by bit become one number.
std::vector<std::uint32_t> welded(std::span<const scene::Facet> facets) {
  const auto before = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::map<Vec3, std::uint32_t, decltype(before)> known(before);
  std::vector<std::uint32_t> position;
  for (const scene::Facet& facet : facets)
    for (const Vec3& x : facet.corner)
      position.push_back(known.try_emplace(x, static_cast<std::uint32_t>(known.size())).first->second);
  return position;
}

/// Corners of facets (3 a facet) that are the same vertex of the surface: joined across edges with one facet on either
/// side. Sheets that touch in a point or along an edge of more than two facets keep vertices of their own.
class Vertices {
 public:
  explicit Vertices(std::span<const scene::Facet> facets) : sets_(3 * facets.size()) {
    const std::vector<std::uint32_t> position = welded(facets);
    std::map<std::pair<std::uint32_t, std::uint32_t>, Corners> edges;  // -> corners that they start at
    for (std::uint32_t corner = 0; corner < position.size(); ++corner)
      edges[std::minmax({position[corner], position[next(corner)]})].push_back(corner);
    for (const auto& [ends, starts] : edges)
      if (starts.size() == 2 && position[starts[0]] != position[starts[1]]) {
        sets_.join(starts[0], next(starts[1]));
        sets_.join(starts[1], next(starts[0]));
      }
  }
  std::size_t of_corner(std::size_t corner) { return sets_.of(static_cast<std::uint32_t>(corner)); }

 private:
  using Corners = std::vector<std::uint32_t>;
  static std::uint32_t next(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

  core::DisjointSets sets_;
};

/// What OpenMesh cannot hold: an edge with facets on both sides already, a vertex without a gap.
bool fits(const TriangleMesh& mesh, const std::array<TriangleMesh::VertexHandle, 3>& v) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto along = mesh.find_halfedge(v[k], v[(k + 1) % 3]);
    if (!mesh.is_boundary(v[k]) || (along.is_valid() && !mesh.is_boundary(along))) return false;
  }
  return v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
}

TriangleMesh connected(std::span<const scene::Facet> facets) {
  TriangleMesh mesh;
  Vertices vertices(facets);
  std::vector<TriangleMesh::VertexHandle> handle(3 * facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    std::array<TriangleMesh::VertexHandle, 3> v;
    for (std::size_t k = 0; k < 3; ++k) {
      auto& of_vertex = handle[vertices.of_corner(3 * f + k)];
      if (!of_vertex.is_valid()) of_vertex = mesh.add_vertex(to_openmesh(facets[f].corner[k]));
      v[k] = of_vertex;
    }
    if (fits(mesh, v) && mesh.add_face(v.data(), 3).is_valid()) continue;
    for (std::size_t k = 0; k < 3; ++k) v[k] = mesh.add_vertex(to_openmesh(facets[f].corner[k]));
    mesh.add_face(v.data(), 3);
  }
  return mesh;
}

double squared_length(const TriangleMesh& mesh, Edge edge) {
  const auto along = mesh.halfedge_handle(edge, 0);
  return (from_openmesh(mesh.point(mesh.to_vertex_handle(along))) -
          from_openmesh(mesh.point(mesh.from_vertex_handle(along))))
      .squaredNorm();
}

double longest_edge(const scene::Facet& facet) {
  const auto& [a, b, c] = facet.corner;
  return std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
}

/// Whether a facet is so thin that the parts it would be cut into come near the rounding of its coordinates.  Bisection
/// makes no angle below half of the smallest given one [Rosenberg, Stenger 1975], so that heights fall no faster than
/// edges do: to about height * max_edge / longest.  (A facet thicker than max_edge is no needle, however small that
/// is.)
bool is_unresolved_needle(const scene::Facet& facet, double max_edge) {
  constexpr double roundings = 32;  // of midpoints of midpoints: 4 are enough on needles 13 edges long, see the test
  double coordinate = 0;
  for (const Vec3& x : facet.corner) coordinate = std::max(coordinate, x.cwiseAbs().maxCoeff());
  const double longest = longest_edge(facet), height = 2 * facet.area / longest;
  return longest > max_edge && height < max_edge &&
         height * (max_edge / longest) <= roundings * std::numeric_limits<double>::epsilon() * coordinate;
}

void bisect_longest(TriangleMesh& mesh, double max_edge) {
  struct Candidate {
    double squared_length;
    int edge;
    bool operator<(const Candidate& o) const {
      return squared_length != o.squared_length ? squared_length < o.squared_length : edge > o.edge;
    }
  };
  const double enough = max_edge * max_edge * (1 + 1e-12);
  std::priority_queue<Candidate> longest;
  const auto consider = [&](Edge edge) {
    if (const double l = squared_length(mesh, edge); l > enough) longest.push({l, edge.idx()});
  };
  for (const auto edge : mesh.edges()) consider(edge);
  while (!longest.empty()) {
    const Edge edge(longest.top().edge);
    const double l = longest.top().squared_length;
    longest.pop();
    if (squared_length(mesh, edge) != l) continue;  // it was cut meanwhile, and its remainder is in the queue
    const auto along = mesh.halfedge_handle(edge, 0);
    const auto middle = (mesh.point(mesh.from_vertex_handle(along)) + mesh.point(mesh.to_vertex_handle(along))) * 0.5;
    const TriangleMesh::VertexHandle cut = mesh.split(edge, middle);
    for (const auto around : mesh.ve_range(cut)) consider(around);
  }
}

/// Triangles from one with these squared edge lengths, a >= b >= c; a quarter of lengths makes a quarter of triangles,
/// once a triangle is large beside the edge.
double count_of(std::array<double, 3> squared, double enough) {
  std::sort(squared.begin(), squared.end(), std::greater<>());
  const auto [a, b, c] = squared;
  if (a <= enough) return 1;
  if (a > 4096 * enough) return 4 * count_of(squared, 4 * enough);
  const double median = std::max(0.0, (2 * b + 2 * c - a) / 4);
  return count_of({a / 4, b, median}, enough) + count_of({a / 4, c, median}, enough);
}

}  // namespace

geometry::IndexedTriangles bisected(std::span<const scene::Facet> facets, double max_edge) {
  if (!(max_edge > 0)) throw core::PreconditionError("bisected: the longest edge must be positive");
  std::vector<scene::Facet> cut, whole;
  for (const scene::Facet& facet : facets) (is_unresolved_needle(facet, max_edge) ? whole : cut).push_back(facet);
  TriangleMesh mesh = connected(cut);
  bisect_longest(mesh, max_edge);
  geometry::IndexedTriangles result;
  for (const auto vertex : mesh.vertices()) result.vertices.push_back(from_openmesh(mesh.point(vertex)));
  for (const auto face : mesh.faces()) {
    std::array<std::uint32_t, 3> triangle{};
    std::size_t k = 0;
    for (const auto vertex : mesh.fv_range(face)) triangle[k++] = static_cast<std::uint32_t>(vertex.idx());
    result.triangles.push_back(triangle);
  }
  for (const scene::Facet& facet : whole) {
    const auto first = static_cast<std::uint32_t>(result.vertices.size());
    result.vertices.insert(result.vertices.end(), facet.corner.begin(), facet.corner.end());
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

double bisected_count(const scene::Facet& facet, double max_edge) {
  const auto squared = [&](std::size_t k) { return (facet.corner[(k + 1) % 3] - facet.corner[k]).squaredNorm(); };
  const double enough = max_edge * max_edge * (1 + 1e-12);
  if (is_unresolved_needle(facet, max_edge)) return 1;
  if (!std::isfinite(squared(0) / enough + squared(1) / enough)) return std::numeric_limits<double>::infinity();
  return count_of({squared(0), squared(1), squared(2)}, enough);
}

}  // namespace interflect::mesh
