#include "montecarlo/light/balls.h"

#include <cmath>

namespace interflect::montecarlo {

std::optional<Balls::Hit> Balls::closest(const Vec3& origin, const Vec3& direction, double within,
                                         std::uint32_t except) const {
  std::optional<Hit> found;
  for (std::uint32_t i = 0; i < balls_.size(); ++i) {
    if (i == except) continue;
    const auto& [centre, radius] = balls_[i];
    const Vec3 to_centre = centre - origin;
    const double middle = to_centre.dot(direction);
    const double left = radius * radius - (to_centre - middle * direction).squaredNorm();
    if (!(left > 0)) continue;
    const double half = std::sqrt(left), t = middle - half > 0 ? middle - half : middle + half;
    if (!(t > 0 && t < within)) continue;
    const Vec3 normal = (origin + t * direction - centre).normalized();
    found = Hit{i, t, centre + radius * normal, normal};
    within = t;
  }
  return found;
}

bool Balls::block(const Vec3& from, const Vec3& to, std::uint32_t except) const {
  const Vec3 way = to - from;
  const double square = way.squaredNorm();
  for (std::uint32_t i = 0; i < balls_.size(); ++i) {
    if (i == except) continue;
    const auto& [centre, radius] = balls_[i];
    const double t = std::clamp(way.dot(centre - from) / square, 0., 1.);
    if ((from + t * way - centre).squaredNorm() < radius * radius) return true;
  }
  return false;
}

}  // namespace interflect::montecarlo
