#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

#include "geometry/convex_blocker.h"

namespace interflect::geometry {
namespace {

using Corner = std::uint32_t;
using DirectedEdge = std::pair<Corner, Corner>;

/// A convex polygon in the making, by the numbers of its corners; empty once it was joined to another.
struct Face {
  std::vector<Corner> corner;
  Vec3 normal;
  bool dark_back;
};

constexpr std::size_t most_faces = 4096;  ///< of a solid: the proof that it is convex is quadratic

class Joining {
 public:
  Joining(std::span<const BlockingTriangle> triangles, double rounding) : rounding_(rounding) {
    for (const BlockingTriangle& t : triangles) {
      const Vec3 area = vector_area(t.corner);
      if (!(area.norm() > 0)) continue;
      faces_.push_back(
          {{number_of(t.corner[0]), number_of(t.corner[1]), number_of(t.corner[2])}, area.normalized(), t.dark_back});
    }
    owner_.resize(faces_.size());
    std::iota(owner_.begin(), owner_.end(), std::uint32_t{0});
  }

  std::vector<ConvexBlocker> run() {
    join_faces();
    std::vector<ConvexBlocker> blockers;
    for (const std::vector<std::uint32_t>& shell : shells()) {
      if (auto solid = solid_of(shell)) {
        blockers.push_back(std::move(*solid));
        continue;
      }
      for (const std::uint32_t f : shell) blockers.push_back(ConvexBlocker::polygon(ring_of(faces_[f])));
    }
    return blockers;
  }

 private:
  Corner number_of(const Vec3& x) {
    const auto [found, is_new] =
        numbers_.emplace(std::array{x.x() + 0.0, x.y() + 0.0, x.z() + 0.0}, static_cast<Corner>(corners_.size()));
    if (is_new) corners_.push_back(x);
    return found->second;
  }
  std::uint32_t root(std::uint32_t f) {
    while (owner_[f] != f) f = owner_[f] = owner_[owner_[f]];
    return f;
  }
  Ring ring_of(const Face& face) const {
    Ring ring;
    for (const Corner c : face.corner) ring.push_back(corners_[c]);
    return ring;
  }

  /// Which faces have a directed edge on their left; those that run along it with another in the same direction are
  /// told apart by a null.
  std::map<DirectedEdge, std::optional<std::uint32_t>> edges() const {
    std::map<DirectedEdge, std::optional<std::uint32_t>> edges;
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0; k < faces_[f].corner.size(); ++k) {
        const auto [found, is_new] =
            edges.emplace(DirectedEdge{faces_[f].corner[k], faces_[f].corner[(k + 1) % faces_[f].corner.size()]}, f);
        if (!is_new) found->second.reset();
      }
    return edges;
  }

  void join_faces() {
    const auto all = edges();
    for (const auto& [edge, left] : all) {
      const auto opposite = all.find({edge.second, edge.first});
      if (edge.first > edge.second || opposite == all.end() || !left || !opposite->second) continue;
      const std::uint32_t a = root(*left), b = root(*opposite->second);
      if (a == b) continue;
      if (auto joined = join(faces_[a], faces_[b], edge)) {
        faces_[a].corner = std::move(*joined);
        faces_[b].corner.clear();
        owner_[b] = a;
      }
    }
  }

  /// The corners of both without the common edge, if they are those of a convex polygon of one plane.
  std::optional<std::vector<Corner>> join(const Face& a, const Face& b, const DirectedEdge& edge) const {
    if (a.dark_back != b.dark_back || a.normal.dot(b.normal) <= 0) return std::nullopt;
    const Vec3& origin = corners_[edge.first];
    const auto off_plane = [&](const Face& of, const Vec3& normal) {
      return std::any_of(of.corner.begin(), of.corner.end(),
                         [&](Corner c) { return std::abs(normal.dot(corners_[c] - origin)) > rounding_; });
    };
    if (off_plane(b, a.normal) || off_plane(a, b.normal)) return std::nullopt;
    const auto rotated = [](std::vector<Corner> ring, Corner first) {
      std::rotate(ring.begin(), std::find(ring.begin(), ring.end(), first), ring.end());
      return ring;
    };
    std::vector<Corner> joined = rotated(a.corner, edge.second);  // .. back to edge.first
    const std::vector<Corner> other = rotated(b.corner, edge.first);
    joined.insert(joined.end(), other.begin() + 1, other.end() - 1);
    return convex(joined, a.normal) ? std::optional(std::move(joined)) : std::nullopt;
  }

  bool convex(const std::vector<Corner>& ring, const Vec3& normal) const {
    std::vector<Corner> sorted = ring;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return false;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec3 &x = corners_[ring[k]], edge = corners_[ring[(k + 1) % ring.size()]] - x;
      const Vec3 inwards = normal.cross(edge).normalized();
      for (const Corner c : ring)
        if (inwards.dot(corners_[c] - x) < -rounding_) return false;
    }
    return true;
  }

  /// Faces that hang together by edges.
  std::vector<std::vector<std::uint32_t>> shells() {
    const auto all = edges();
    std::iota(owner_.begin(), owner_.end(), std::uint32_t{0});
    for (const auto& [edge, left] : all) {
      const auto opposite = all.find({edge.second, edge.first});
      if (opposite != all.end() && left && opposite->second) owner_[root(*left)] = root(*opposite->second);
    }
    std::map<std::uint32_t, std::vector<std::uint32_t>> by_root;
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
      if (!faces_[f].corner.empty()) by_root[root(f)].push_back(f);
    std::vector<std::vector<std::uint32_t>> shells;
    for (auto& [r, shell] : by_root) shells.push_back(std::move(shell));
    return shells;
  }

  std::optional<ConvexBlocker> solid_of(const std::vector<std::uint32_t>& shell) const {
    if (shell.size() < 4 || shell.size() > most_faces) return std::nullopt;
    std::vector<Ring> rings;
    for (const std::uint32_t f : shell) {
      if (!faces_[f].dark_back) return std::nullopt;
      rings.push_back(ring_of(faces_[f]));
    }
    for (const std::uint32_t f : shell)
      for (const Ring& ring : rings)
        for (const Vec3& x : ring)
          if (faces_[f].normal.dot(x - corners_[faces_[f].corner[0]]) > rounding_) return std::nullopt;
    try {
      return ConvexBlocker::solid(rings);
    } catch (const Defect&) {  // not closed
      return std::nullopt;
    }
  }

  double rounding_;
  std::map<std::array<double, 3>, Corner> numbers_;
  std::vector<Vec3> corners_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> owner_;  ///< union-find over faces
};

}  // namespace

std::vector<ConvexBlocker> convex_blockers(std::span<const BlockingTriangle> triangles, double rounding) {
  return Joining(triangles, rounding).run();
}

}  // namespace interflect::geometry
