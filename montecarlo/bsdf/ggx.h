#pragma once

#include <cmath>

#include "core/hemisphere.h"

namespace interflect::montecarlo {

/// Normals of the facets of a rough surface [Trowbridge, Reitz 1975; Walter et al. 2007]:
///
///   D(h) = a² / (pi ((a² - 1) c² + 1)²),  c = h . n,     int D(h) c d sigma_h = 1
///   Lambda(v) = (-1 + sqrt(1 + a² tan² v)) / 2,   G1 = 1 / (1 + Lambda),   G2 = 1 / (1 + Lambda(a) + Lambda(b))
///
/// G2 is for heights that are correlated, of two directions on any sides [Heitz 2014].  Directions are unit, z > 0 but
/// where said otherwise.
class Ggx {
 public:
  explicit Ggx(double alpha) : a_(alpha), aa_(alpha * alpha) {}

  double density(const Vec3& h) const {
    const double part = h.x() * h.x() + h.y() * h.y() + aa_ * h.z() * h.z();
    return aa_ / (pi * part * part);
  }
  /// Of a direction on either side.
  double lambda(const Vec3& v) const {
    return 0.5 * (std::sqrt(1 + aa_ * (v.x() * v.x() + v.y() * v.y()) / (v.z() * v.z())) - 1);
  }
  double visible(const Vec3& v) const { return 1 / (1 + lambda(v)); }
  double visible(const Vec3& a, const Vec3& b) const { return 1 / (1 + lambda(a) + lambda(b)); }

  /// A normal among those that are seen from v, with the pdf below [Heitz 2018, "Sampling the GGX distribution of
  /// visible normals", JCGT 7(4)].
  Vec3 sample(const Vec3& v, double u, double w) const {
    const auto [s, t, stretched, lift] = seen_from(v);
    const double r = std::sqrt(u), x = r * std::cos(2 * pi * w);
    const double y = (1 - lift) * std::sqrt(1 - x * x) + lift * r * std::sin(2 * pi * w);
    const Vec3 h = x * s + y * t + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * stretched;
    return Vec3(a_ * h.x(), a_ * h.y(), std::max(0.0, h.z())).normalized();
  }
  /// (u, w) of a normal that is seen from v: tests go there and back.  Round trip: 1e-12 of u and of sqrt(u) w.
  Vec2 inverse(const Vec3& v, const Vec3& h) const {
    const auto [s, t, towards_v, lift] = seen_from(v);
    const Vec3 on_ball = Vec3(h.x() / a_, h.y() / a_, h.z()).normalized();
    const double x = on_ball.dot(s);
    const double y = (on_ball.dot(t) - (1 - lift) * std::sqrt(std::max(0.0, 1 - x * x))) / lift;  // before the lift
    return {x * x + y * y, core::turns_about_z({x, y, 0})};
  }
  /// Of `sample` [1/sr of h].
  double pdf_solid_angle(const Vec3& v, const Vec3& h) const {
    return visible(v) * std::max(0.0, v.dot(h)) * density(h) / v.z();
  }

 private:
  /// The half ball that facets are where space is stretched to make them smooth: from v it is seen as a disk, half of
  /// which its edge cuts by `lift`.
  struct HalfBall {
    Vec3 s, t, v;
    double lift;
  };
  HalfBall seen_from(const Vec3& v) const {
    const Vec3 stretched = Vec3(a_ * v.x(), a_ * v.y(), v.z()).normalized();
    const double across = stretched.x() * stretched.x() + stretched.y() * stretched.y();
    const Vec3 s = across > 0 ? Vec3(Vec3(-stretched.y(), stretched.x(), 0) / std::sqrt(across)) : Vec3(1, 0, 0);
    return {s, stretched.cross(s), stretched, 0.5 * (1 + stretched.z())};
  }

  double a_, aa_;
};

}  // namespace interflect::montecarlo
