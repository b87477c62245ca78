#include "fem/form_factor/pair_shadow.h"

#include <algorithm>

namespace interflect::fem {

using geometry::ConvexBlocker;
using geometry::HalfSpace;

bool PairShadow::prepare(const ConvexBlocker& blocker, std::span<const Vec3> outer, std::span<const Vec3> inner,
                         double rounding) {
  blocker_ = &blocker;
  rounding_ = rounding;
  edges_.clear();
  faces_.clear();
  turning_.clear();
  find_sights(outer);
  touches_ = std::find(sight_.begin(), sight_.end(), Sight::from_all) == sight_.end();
  return keep_faces(inner) && keep_edges(outer, inner);
}

void PairShadow::find_sights(std::span<const Vec3> outer) {
  sight_.clear();
  for (std::uint32_t f = 0; f < blocker_->planes().size(); ++f) {
    std::size_t front = 0;
    for (const Vec3& eye : outer) front += fronts(f, eye);
    sight_.push_back(front == 0 ? Sight::from_none : front == outer.size() ? Sight::from_all : Sight::from_some);
  }
}

/// What lies before a fronting face is not hidden: those that have all of the inner polygon behind them matter to no
/// eye.
bool PairShadow::keep_faces(std::span<const Vec3> inner) {
  for (std::uint32_t f = 0; f < sight_.size(); ++f) {
    if (sight_[f] == Sight::from_none) continue;
    const geometry::Plane& plane = blocker_->planes()[f];
    const auto behind =
        std::count_if(inner.begin(), inner.end(), [&](const Vec3& y) { return plane.distance(y) <= 0; });
    if (behind == static_cast<std::ptrdiff_t>(inner.size())) continue;
    if (behind == 0 && sight_[f] == Sight::from_all) return false;
    faces_.push_back({plane, sight_[f] == Sight::from_all});
  }
  return true;
}

bool PairShadow::keep_edges(std::span<const Vec3> outer, std::span<const Vec3> inner) {
  turns_.assign(sight_.size(), 0);
  for (const ConvexBlocker::Edge& edge : blocker_->edges()) {
    const Sight left = sight_[edge.left], right = sight_[edge.right];
    if (left == right && left != Sight::from_some) continue;  // in no outline
    const bool either = left == right, left_fronts = left > right;
    const bool fixed = left != Sight::from_some && right != Sight::from_some;
    const Vec3 &from = blocker_->corners()[edge.from], &to = blocker_->corners()[edge.to];
    if (!either) {
      const Where place = left_fronts ? where(from, to, outer, inner) : where(to, from, outer, inner);
      if (place == Where::inside) continue;
      if (place == Where::outside && fixed) return false;
    }
    edges_.push_back({from, to, edge.left, edge.right, fixed, left_fronts});
    if (left == Sight::from_some) turns_[edge.left] = 1;
    if (right == Sight::from_some) turns_[edge.right] = 1;
  }
  for (std::uint32_t f = 0; f < turns_.size(); ++f)
    if (turns_[f]) turning_.push_back(blocker_->planes()[f]);
  return true;
}

/// Of the inner polygon to the planes through eyes and an edge, whose face with the edge on its left fronts the eyes.
PairShadow::Where PairShadow::where(const Vec3& from, const Vec3& to, std::span<const Vec3> outer,
                                    std::span<const Vec3> inner) const {
  bool inside = true, outside = true;
  for (const Vec3& eye : outer) {
    const Vec3 inwards = (to - eye).cross(from - eye);
    const double margin = inwards.norm() * rounding_;
    for (const Vec3& y : inner) {
      const double d = inwards.dot(y - eye);
      inside = inside && d >= margin;
      outside = outside && d <= -margin;
    }
    if (!inside && !outside) return Where::across;
  }
  return inside ? Where::inside : outside ? Where::outside : Where::across;
}

void PairShadow::append(const Vec3& eye, std::vector<HalfSpace>& shadow) const {
  for (const Edge& edge : edges_) {
    bool left = edge.left_fronts, right = !left;
    if (!edge.fixed) left = fronts(edge.left, eye), right = fronts(edge.right, eye);
    if (left == right) continue;
    const Vec3 from = edge.from - eye, to = edge.to - eye, inwards = left ? to.cross(from) : from.cross(to);
    if (inwards.squaredNorm() > 0) shadow.push_back({inwards, 0});
  }
  for (const Face& face : faces_) {
    const double height = face.plane.distance(eye);
    if (height > rounding_) shadow.push_back({-face.plane.normal, height});
  }
}

}  // namespace interflect::fem
