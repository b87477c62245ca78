#include "mesh/smooth_mesh.h"

#include <set>

#include "mesh/shared_points.h"

namespace interflect::mesh {
namespace {

using Key = std::array<double, 3>;
Key key(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

/// One side of a surface.
class Side {
 public:
  Side(const ElementMesh& mesh, const ElementMesh::Part& part, SmoothMesh& out) : mesh_(mesh), out_(out) {
    for (std::uint32_t i = part.first; i < part.first + part.count; ++i)
      for (const Vec3& corner : mesh.patches()[i].ring()) corners_.insert(key(corner));
    for (std::uint32_t i = part.first; i < part.first + part.count; ++i) append(i);
  }

 private:
  void append(std::uint32_t element) {
    const scene::SurfacePatch& patch = mesh_.patches()[element];
    const Vec3 normal = patch.normal(), middle = patch.centroid();
    std::vector<Vec3> outline;
    const auto ring = patch.ring();
    for (std::size_t k = 0; k < ring.size(); ++k) append_halves(ring[k], ring[(k + 1) % ring.size()], outline, 0);
    const std::uint32_t centre = own(middle, element);
    std::vector<std::uint32_t> rim, spokes;
    for (const Vec3& p : outline) {
      rim.push_back(shared(p, normal, element));
      spokes.push_back(own(0.5 * (middle + p), element));
    }
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const std::size_t next = (k + 1) % outline.size();
      const std::uint32_t half = shared(0.5 * (outline[k] + outline[next]), normal, element);
      out_.triangles.push_back({centre, rim[k], rim[next], spokes[k], half, spokes[next]});
      out_.element.push_back(element);
    }
  }

  /// a and the corners that hang between a and b: where an edge was halved, its middle is a corner of others.
  void append_halves(const Vec3& a, const Vec3& b, std::vector<Vec3>& outline, int depth) const {
    constexpr int deepest = 40;  // halvings of a length that doubles can tell apart
    const Vec3 middle = 0.5 * (a + b);
    if (depth < deepest && corners_.contains(key(middle))) {
      append_halves(a, middle, outline, depth + 1);
      append_halves(middle, b, outline, depth + 1);
    } else {
      outline.push_back(a);
    }
  }

  std::uint32_t own(const Vec3& p, std::uint32_t element) {
    out_.points.push_back(p);
    out_.around.push_back({element});
    return static_cast<std::uint32_t>(out_.points.size() - 1);
  }
  std::uint32_t shared(const Vec3& p, const Vec3& normal, std::uint32_t element) {
    if (const auto known = shared_.find(p, normal)) {
      if (out_.around[*known].back() != element) out_.around[*known].push_back(element);
      return *known;
    }
    const std::uint32_t point = own(p, element);
    shared_.add(p, normal, point);
    return point;
  }

  const ElementMesh& mesh_;
  SmoothMesh& out_;
  std::set<Key> corners_;
  SharedPoints shared_;
};

}  // namespace

SmoothMesh smooth_mesh(const ElementMesh& mesh) {
  SmoothMesh out;
  for (const ElementMesh::Part& part : mesh.parts()) Side(mesh, part, out);
  return out;
}

}  // namespace interflect::mesh
