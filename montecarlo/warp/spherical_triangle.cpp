#include "montecarlo/warp/spherical_triangle.h"

#include <algorithm>
#include <cmath>

namespace interflect::montecarlo {
namespace {

double solid_angle_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double det = std::abs(a.dot(b.cross(c))), below = 1 + a.dot(b) + b.dot(c) + c.dot(a);
  return det == 0 && below <= 0 ? 0 : 2 * std::atan2(det, below);
}

/// The part of `of` perpendicular to a unit vector, of length 1.
Vec3 beside(const Vec3& of, const Vec3& unit) {
  const Vec3 part = of - of.dot(unit) * unit;
  const double length = part.norm();
  return length > 0 ? Vec3(part / length) : Vec3(Vec3::Zero());
}

}  // namespace

SphericalTriangle::SphericalTriangle(const std::array<Vec3, 3>& corner)
    : a_(corner[0]), b_(corner[1]), c_(corner[2]), cos_ab_(a_.dot(b_)), solid_angle_(solid_angle_of(a_, b_, c_)) {
  const Vec3 ab = a_.cross(b_), ac = a_.cross(c_);
  sin_ab_ = ab.norm();
  const double both = sin_ab_ * ac.norm();
  cos_alpha_ = both > 0 ? ab.dot(ac) / both : 1;
  sin_alpha_ = both > 0 ? std::abs(a_.dot(b_.cross(c_))) / both : 0;
}

Vec3 SphericalTriangle::direction(double u, double v) const {
  // tan(b' / 2) = y / x of the arc b' from a to c'.
  const double half = u * solid_angle_ / 2, sine = std::sin(half), cosine = std::cos(half);
  const double y = sine * (1 + cos_ab_), x = sin_ab_ * (sin_alpha_ * cosine - cos_alpha_ * sine);
  const double square = x * x + y * y;
  const Vec3 cut = square > 0 ? Vec3(((x - y) * (x + y) * a_ + 2 * x * y * beside(c_, a_)) / square) : a_;
  // 1 - cos of the arc from b, without cancellation.
  const double z = v * (cut - b_).squaredNorm() / 2;
  return ((1 - z) * b_ + std::sqrt(std::max(0., z * (2 - z))) * beside(cut, b_)).normalized();
}

Vec2 SphericalTriangle::inverse(const Vec3& direction) const {
  Vec3 cut = b_.cross(direction).cross(c_.cross(a_));
  if (cut.dot(a_ + c_) < 0) cut = -cut;
  if (!(cut.squaredNorm() > 0)) return {1, 0};  // at b, where all arcs meet
  cut.normalize();
  return {std::clamp(solid_angle_of(a_, b_, cut) / solid_angle_, 0., 1.),
          std::clamp((direction - b_).squaredNorm() / (cut - b_).squaredNorm(), 0., 1.)};
}

}  // namespace interflect::montecarlo
