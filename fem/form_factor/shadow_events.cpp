#include "fem/form_factor/shadow_events.h"

#include <algorithm>
#include <array>
#include <utility>

#include "geometry/split.h"

namespace interflect::fem {
namespace {

using geometry::HalfSpace;

/// On which side of the line through x and y p lies, all in the plane across `normal`.
double side(const Vec3& x, const Vec3& y, const Vec3& p, const Vec3& normal) {
  return (y - x).cross(p - x).dot(normal);
}

}  // namespace

void ShadowEvents::add(const PairShadow& shadow) {
  for (const geometry::Plane& face : shadow.turning()) add_face(face);
  collect_corners(shadow);
  for (const PairShadow::Edge& edge : shadow.edges())
    for (const Vec3& corner : inner_) add_corner_and_edge(corner, edge.from, edge.to);
  for (const Vec3& corner : corners_)
    for (std::size_t k = 0; k < inner_.size(); ++k)
      add_corner_and_edge(corner, inner_[k], inner_[k + 1 < inner_.size() ? k + 1 : 0]);
}

void ShadowEvents::collect_corners(const PairShadow& shadow) {
  corners_.clear();
  for (const PairShadow::Edge& edge : shadow.edges())
    for (const Vec3& corner : {edge.from, edge.to})
      if (std::find(corners_.begin(), corners_.end(), corner) == corners_.end()) corners_.push_back(corner);
}

void ShadowEvents::add_between(const PairShadow& a, const PairShadow& b) {
  add_corners_and_edges(a, b);
  add_corners_and_edges(b, a);
}

void ShadowEvents::add_corners_and_edges(const PairShadow& corners, const PairShadow& edges) {
  collect_corners(corners);
  Vec3 from, to;
  for (const Vec3& corner : corners_)
    for (const PairShadow::Edge& edge : edges.edges()) {
      const Vec3 normal = (edge.to - edge.from).cross(corner - edge.from);
      const HalfSpace plane{normal, normal.dot(corner)};
      if (chord(plane, from, to) && in_line(from, to, corner, edge.from, edge.to, normal) &&
          points_at_inner(from, to, corner))
        planes_.push_back(plane);
    }
}

/// Where the plane cuts the outer ring, if it does: not in a corner or along an edge.
bool ShadowEvents::chord(const HalfSpace& plane, Vec3& from, Vec3& to) {
  const double margin = plane.normal.norm() * rounding_;
  double lowest = 0, highest = 0;
  distance_.clear();
  for (const Vec3& x : outer_) {
    distance_.push_back(plane.normal.dot(x) - plane.offset);
    lowest = std::min(lowest, distance_.back());
    highest = std::max(highest, distance_.back());
  }
  if (lowest >= -margin || highest <= margin) return false;
  for (std::size_t k = 0; k < outer_.size(); ++k) {
    const std::size_t next = k + 1 < outer_.size() ? k + 1 : 0;
    const double d = distance_[k], e = distance_[next];
    if ((d < 0) == (e < 0)) continue;
    (d < 0 ? from : to) = outer_[k] + d / (d - e) * (outer_[next] - outer_[k]);
  }
  return true;
}

void ShadowEvents::cut(geometry::RingList& parts) {
  for (const HalfSpace& plane : planes_) {
    std::swap(parts, before_);
    parts.clear();
    for (std::size_t k = 0; k < before_.size(); ++k) {
      if (geometry::side_of(before_[k], plane, distance_) != geometry::HalfSide::across) {
        parts.push_back(before_[k]);
        continue;
      }
      geometry::split(before_[k], distance_, inside_, outside_);
      for (const std::vector<Vec3>* part : {&inside_, &outside_})
        if (part->size() >= 3) parts.push_back(*part);
    }
  }
}

void ShadowEvents::add_face(const geometry::Plane& face) {
  const HalfSpace plane{face.normal, face.offset};
  Vec3 from, to;
  if (chord(plane, from, to)) planes_.push_back(plane);
}

/// The plane through a corner and an edge, if there is a point of its chord from which the corner lies in line with the
/// edge, between its ends: both EV and VE.
void ShadowEvents::add_corner_and_edge(const Vec3& corner, const Vec3& a, const Vec3& b) {
  const Vec3 normal = (b - a).cross(corner - a);
  const HalfSpace plane{normal, normal.dot(corner)};
  Vec3 from, to;
  if (!chord(plane, from, to)) return;
  if (in_line(from, to, corner, a, b, normal)) planes_.push_back(plane);
}

/// Whether from some point of the chord the corner is in line with the edge, between its ends or at one, within
/// rounding: an edge may end on the line from a floor's corner along that floor.
bool ShadowEvents::in_line(const Vec3& from, const Vec3& to, const Vec3& corner, const Vec3& a, const Vec3& b,
                           const Vec3& normal) const {
  const auto [low, high] = std::minmax({side(from, corner, a, normal), side(from, corner, b, normal),
                                        side(to, corner, a, normal), side(to, corner, b, normal)});
  const double margin = rounding_ * std::max((corner - from).norm(), (corner - to).norm()) * normal.norm();
  return low <= margin && high >= -margin;
}

/// False only if no ray from the chord through the corner goes on to the inner polygon: the rays meet its plane in a
/// segment, which may have all of the polygon on one side, or lie beyond one of its edges.
bool ShadowEvents::points_at_inner(const Vec3& from, const Vec3& to, const Vec3& corner) const {
  const Vec3 normal = (inner_[1] - inner_[0]).cross(inner_[2] - inner_[0]);
  const auto height = [&](const Vec3& x) { return normal.dot(x - inner_[0]); };
  const double below = height(corner);
  if (below < 0) return false;
  std::array<Vec3, 2> meets;
  for (std::size_t k = 0; const Vec3& x : {from, to}) {
    const double above = height(x);
    if (above <= below) return true;
    meets[k++] = x + above / (above - below) * (corner - x);
  }
  for (std::size_t k = 0; k < inner_.size(); ++k) {
    const Vec3 inwards = normal.cross(inner_[k + 1 < inner_.size() ? k + 1 : 0] - inner_[k]);
    if (inwards.dot(meets[0] - inner_[k]) < 0 && inwards.dot(meets[1] - inner_[k]) < 0) return false;
  }
  return true;
}

}  // namespace interflect::fem
