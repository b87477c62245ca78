#include "geometry/union_corners.h"

#include <cmath>

namespace interflect::geometry {

std::span<const Vec3> UnionCorners::operator()(const RingList& rings, const Vec3& normal, double same_place) {
  places_.clear();
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const auto ring = rings[r];
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec3 before = ring[k == 0 ? ring.size() - 1 : k - 1] - ring[k],
                 after = ring[k + 1 < ring.size() ? k + 1 : 0] - ring[k];
      add(ring[k], std::atan2(std::abs(before.cross(after).dot(normal)), before.dot(after)), same_place);
    }
  }
  constexpr double level = 1e-6;  // [rad]
  corners_.clear();
  for (const Place& place : places_)
    if (std::abs(std::remainder(place.angle, pi)) > level) corners_.push_back(place.at);
  return corners_;
}

void UnionCorners::add(const Vec3& at, double angle, double same_place) {
  for (Place& place : places_)
    if ((place.at - at).cwiseAbs().maxCoeff() <= same_place) {
      place.angle += angle;
      return;
    }
  places_.push_back({at, angle});
}

}  // namespace interflect::geometry
