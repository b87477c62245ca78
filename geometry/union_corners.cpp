#include "geometry/union_corners.h"

#include <cmath>

namespace interflect::geometry {
namespace {

bool same(const Vec3& a, const Vec3& b, double same_place) { return (a - b).cwiseAbs().maxCoeff() <= same_place; }

}  // namespace

std::span<const Vec3> UnionCorners::operator()(const RingList& rings, const Vec3& normal, double same_place) {
  places_.clear();
  for (std::size_t r = 0; r < rings.size(); ++r) {
    collect_distinct(rings[r], same_place);
    const std::size_t n = distinct_.size();
    if (n < 3) continue;
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 before = distinct_[k == 0 ? n - 1 : k - 1] - distinct_[k],
                 after = distinct_[k + 1 < n ? k + 1 : 0] - distinct_[k];
      add(distinct_[k], std::atan2(std::abs(before.cross(after).dot(normal)), before.dot(after)), same_place);
    }
  }
  constexpr double level = 1e-6;  // [rad]
  corners_.clear();
  for (const Place& place : places_)
    if (std::abs(std::remainder(place.angle, pi)) > level) corners_.push_back(place.at);
  return corners_;
}

/// Where more than two cuts meet they leave edges as long as their rounding, whose directions mean nothing.
void UnionCorners::collect_distinct(std::span<const Vec3> ring, double same_place) {
  distinct_.clear();
  for (const Vec3& at : ring)
    if (distinct_.empty() || !same(at, distinct_.back(), same_place)) distinct_.push_back(at);
  while (distinct_.size() > 1 && same(distinct_.back(), distinct_.front(), same_place)) distinct_.pop_back();
}

void UnionCorners::add(const Vec3& at, double angle, double same_place) {
  for (Place& place : places_)
    if (same(place.at, at, same_place)) {
      place.angle += angle;
      return;
    }
  places_.push_back({at, angle});
}

}  // namespace interflect::geometry
