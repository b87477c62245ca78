#include "fem/form_factor/seen_element.h"

#include <algorithm>
#include <cmath>

namespace interflect::fem {
namespace {

constexpr double least_solid_angle = 1e-12;

/// The unit vector across `axis` towards x.
Vec3 across(const Vec3& x, const Vec3& axis) { return (x - x.dot(axis) * axis).normalized(); }

/// On the great circle from the unit vector `axis` towards x, at an angle of that cosine.
Vec3 on_arc(const Vec3& axis, const Vec3& x, double cosine) {
  return cosine * axis + std::sqrt(std::max(0.0, 1 - cosine * cosine)) * across(x, axis);
}

}  // namespace

SeenTriangle::SeenTriangle(const Vec3& eye, const Vec3& a, const Vec3& b, const Vec3& c)
    : a_((a - eye).normalized()), b_((b - eye).normalized()), c_((c - eye).normalized()) {
  // Counter-clockwise from in front, the corners turn clockwise about the direction of sight.
  const double volume = -a_.dot(b_.cross(c_));
  if (!(volume > 0)) return;
  const double solid_angle = 2 * std::atan2(volume, 1 + a_.dot(b_) + b_.dot(c_) + c_.dot(a_));
  if (!(solid_angle > least_solid_angle)) return;
  const Vec3 to_b = across(b_, a_), to_c = across(c_, a_);
  cos_alpha_ = to_b.dot(to_c);
  sin_alpha_ = to_b.cross(to_c).norm();
  if (sin_alpha_ > 0) solid_angle_ = solid_angle;
}

Vec3 SeenTriangle::direction(double u, double v) const {
  // The part of the triangle between b, a and a point c' of the arc ac has area u times the whole.
  const double phi = u * solid_angle_ - std::atan2(sin_alpha_, cos_alpha_), s = std::sin(phi), t = std::cos(phi);
  const double p = t - cos_alpha_, q = s + sin_alpha_ * a_.dot(b_);
  const double below = (q * s + p * t) * sin_alpha_;
  const double cosine = below != 0 ? std::clamp(((q * t - p * s) * cos_alpha_ - q) / below, a_.dot(c_), 1.0) : 1.0;
  const Vec3 c = on_arc(a_, c_, cosine);
  return on_arc(b_, c, 1 - v * (1 - c.dot(b_)));
}

SeenElement::SeenElement(const Vec3& eye, std::span<const Vec3> ring)
    : part_{SeenTriangle(eye, ring[0], ring[1], ring[2]), {}} {
  if (ring.size() == 4) part_[1] = SeenTriangle(eye, ring[0], ring[2], ring[3]);
}

Vec3 SeenElement::direction(double u, double v) const {
  const double first = part_[0].solid_angle() / solid_angle();
  if (u < first) return part_[0].direction(u / first, v);
  return part_[1].direction((u - first) / (1 - first), v);
}

}  // namespace interflect::fem
