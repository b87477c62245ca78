#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/vec.h"

/// Directions about a normal.
namespace interflect::core {

/// Two tangents and a unit normal, right-handed.
struct Frame {
  Vec3 s, t, n;
  Vec3 to_world(const Vec3& local) const { return local.x() * s + local.y() * t + local.z() * n; }
  Vec3 to_local(const Vec3& world) const { return {s.dot(world), t.dot(world), n.dot(world)}; }
};

/// Source: [Duff et al. 2017] "Building an orthonormal basis, revisited", JCGT 6(1): no branch, no singular direction.
inline Frame frame_around(const Vec3& n) {
  const double sign = std::copysign(1.0, n.z());
  const double a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
  return {{1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()}, {b, sign + n.y() * n.y() * a, -n.y()}, n};
}

/// Sine and cosine of `turns` whole turns, 0 <= turns <= 1, within 2.5e-16: without a branch, so that loops over them
/// become vectors.  By Taylor's series in what is left of the nearest quarter, |x| <= pi / 4, whose next terms are
/// 5e-17 and 2e-18.
inline void sin_cos_turns(double turns, double& sine, double& cosine) {
  const int quarter = static_cast<int>(4 * turns + 0.5);
  const double x = 2 * pi * (turns - 0.25 * quarter), xx = x * x;
  const double s =
      x * (1 + xx * (-1. / 6 +
                     xx * (1. / 120 +
                           xx * (-1. / 5040 +
                                 xx * (1. / 362880 +
                                       xx * (-1. / 39916800 + xx * (1. / 6227020800 + xx * (-1. / 1307674368000))))))));
  const double c =
      1 + xx * (-1. / 2 +
                xx * (1. / 24 +
                      xx * (-1. / 720 +
                            xx * (1. / 40320 +
                                  xx * (-1. / 3628800 + xx * (1. / 479001600 + xx * (-1. / 87178291200 +
                                                                                     xx * (1. / 20922789888000))))))));
  const double odd = quarter & 1, even = 1 - odd;
  sine = (1 - (quarter & 2)) * (even * s + odd * c);
  cosine = (1 - ((quarter + 1) & 2)) * (even * c + odd * s);
}

/// Turns of a direction about z, 0 <= t < 1.
inline double turns_about_z(const Vec3& way) {
  const double turns = std::atan2(way.y(), way.x()) / (2 * pi);
  return turns < 0 ? std::min(turns + 1, 1 - 0x1p-53) : turns;
}

/// A direction about +z with pdf_solid_angle = cos(theta) / pi [1/sr]; z > 0 always, for u < 1.  (Malley: a uniform
/// disk, lifted.)  Round trip: 1e-12.
inline Vec3 cosine_hemisphere(double u, double v) {
  double sine, cosine;
  sin_cos_turns(v, sine, cosine);
  const double r = std::sqrt(u);
  return {r * cosine, r * sine, std::sqrt(1 - u)};
}

/// (u, v) of a direction: tests go there and back.
inline Vec2 cosine_hemisphere_inverse(const Vec3& way) {
  return {way.x() * way.x() + way.y() * way.y(), turns_about_z(way)};
}

/// Many of them at once, which is several times sooner.
template <int N>
struct CosineHemisphere {
  Eigen::Array<double, N, 1> u = Eigen::Array<double, N, 1>::Zero(), v = u;

  void find() {
    for (Index k = 0; k < N; ++k) sin_cos_turns(v[k], y_[k], x_[k]);
    const Eigen::Array<double, N, 1> r = u.sqrt();
    x_ *= r, y_ *= r, z_ = (1 - u).sqrt();
  }
  Vec3 operator[](Index k) const { return {x_[k], y_[k], z_[k]}; }

 private:
  Eigen::Array<double, N, 1> x_, y_, z_;
};

/// A point of a triangle with pdf_area = 1 / area [Turk 1990].  Round trip: 1e-12 of u and of sqrt(u) v, of triangles
/// that are not far from the origin for their size.
inline Vec3 triangle_point(const Vec3& a, const Vec3& b, const Vec3& c, double u, double v) {
  const double s = std::sqrt(u);
  return a + s * (1 - v) * (b - a) + s * v * (c - a);
}

/// Of `triangle_point` [1/m²].
inline double triangle_point_pdf_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 2 / (b - a).cross(c - a).norm();
}

/// (u, v) of a point of the triangle's plane, for tests too; of corner a, where all v meet, v = 0.
inline Vec2 triangle_point_inverse(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& point) {
  const Vec3 normal = (b - a).cross(c - a);
  const double to_b = (point - a).cross(c - a).dot(normal), to_c = (b - a).cross(point - a).dot(normal);
  const double both = to_b + to_c, s = both / normal.squaredNorm();
  return {s * s, both > 0 ? to_c / both : 0};
}

}  // namespace interflect::core
