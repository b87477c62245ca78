#include "geometry/convex_blocker.h"

#include <algorithm>
#include <map>

namespace interflect::geometry {

ConvexBlocker ConvexBlocker::polygon(std::span<const Vec3> ring) {
  ConvexBlocker blocker;
  const Plane front = plane_of(ring);
  blocker.corners_.assign(ring.begin(), ring.end());
  blocker.rings_.push_back(blocker.corners_);
  blocker.planes_ = {front, {-front.normal, -front.offset}};
  const auto corners = static_cast<std::uint32_t>(ring.size());
  for (std::uint32_t k = 0; k < corners; ++k) blocker.edges_.push_back({k, (k + 1) % corners, 0, 1});
  return blocker;
}

ConvexBlocker ConvexBlocker::solid(std::span<const Ring> faces) {
  ConvexBlocker blocker;
  const auto less = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::map<Vec3, std::uint32_t, decltype(less)> corner_at(less);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> left_of;  // directed edge -> face
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    std::vector<std::uint32_t> at;
    for (const Vec3& x : faces[f]) {
      const auto [found, is_new] = corner_at.emplace(x, static_cast<std::uint32_t>(blocker.corners_.size()));
      if (is_new) blocker.corners_.push_back(x);
      at.push_back(found->second);
    }
    for (std::size_t k = 0; k < at.size(); ++k)
      if (!left_of.emplace(std::pair(at[k], at[(k + 1) % at.size()]), f).second)
        throw Defect("two faces run the same way along an edge");
    blocker.rings_.push_back(faces[f]);
    blocker.planes_.push_back(plane_of(faces[f]));
  }
  for (const auto& [edge, left] : left_of) {
    const auto right = left_of.find({edge.second, edge.first});
    if (right == left_of.end()) throw Defect("an edge belongs to one face alone");
    if (edge.first < edge.second) blocker.edges_.push_back({edge.first, edge.second, left, right->second});
  }
  return blocker;
}

bool ConvexBlocker::append_shadow(const Vec3& eye, double rounding, std::vector<HalfSpace>& shadow) const {
  const auto fronts = [&](std::uint32_t face) { return planes_[face].distance(eye) > rounding; };
  const auto seen = [&](const Plane& face) { return face.distance(eye) > rounding; };
  if (std::none_of(planes_.begin(), planes_.end(), seen)) return false;
  for (const Edge& edge : edges_) {
    const bool left = fronts(edge.left), right = fronts(edge.right);
    if (left == right) continue;
    const Vec3 from = corners_[edge.from] - eye, to = corners_[edge.to] - eye;
    const Vec3 inwards = left ? to.cross(from) : from.cross(to);
    if (inwards.squaredNorm() > 0) shadow.push_back({inwards, 0});
  }
  for (std::uint32_t f = 0; f < planes_.size(); ++f)
    if (fronts(f)) shadow.push_back({-planes_[f].normal, planes_[f].distance(eye)});
  return true;
}

}  // namespace interflect::geometry
