#pragma once

#include "montecarlo/light/light.h"
#include "montecarlo/warp.h"

namespace interflect::montecarlo {

/// What lights have in common that are the front of a flat, diffuse surface with the exitance E: L = E / pi, Phi = A E.
class DiffuseSide : public Light {
 public:
  Spectrum flux() const final { return area_ * exitance_; }
  Spectrum radiance(const Vec3&, const Vec3& way) const final {
    return way.dot(normal_) > 0 ? radiance_ : Spectrum::zero();
  }
  LargestFind largest_find(double) const final { return {exitance_, Spectrum(infinite)}; }
  EmissionPdfs pdfs_emission(const Vec3&, const Vec3& way) const final {
    return {1 / area_, cosine_hemisphere_pdf_solid_angle(way.dot(normal_))};
  }

  /// Below this solid angle what is left of its digits is not worth having [sr].
  static constexpr double smallest_solid_angle = 1e-4;

 protected:
  DiffuseSide(const Vec3& normal, double area, const Spectrum& exitance, const Vec3& centre, double diameter)
      : normal_(normal),
        area_(area),
        exitance_(exitance),
        radiance_(exitance * inv_pi),
        centre_(centre),
        diameter_(diameter),
        reach2_(pays_within2 * diameter * diameter) {}

  bool is_before(const Vec3& x) const { return (x - centre_).dot(normal_) > 0; }
  bool is_near(const Vec3& x) const { return (x - centre_).squaredNorm() < reach2_; }

  /// No point of it is further away [m].
  double reach_from(const Vec3& x) const { return (x - centre_).norm() + diameter_; }

  std::optional<Arriving> arriving_by_area(const Vec3& x, const Vec3& y) const {
    const Vec3 way = y - x;
    const double square = way.squaredNorm(), over_r = 1 / std::sqrt(square), cosine = -normal_.dot(way) * over_r;
    if (!(cosine > 0)) return std::nullopt;
    return Arriving{way * over_r, square * over_r, y, normal_, radiance_, square / (area_ * cosine)};
  }
  std::optional<Arriving> arriving(const Vec3& x, const Vec3& y, double pdf_solid_angle) const {
    const Vec3 way = y - x;
    const double r = way.norm();
    if (!(r > 0)) return std::nullopt;
    return Arriving{way / r, r, y, normal_, radiance_, pdf_solid_angle};
  }
  double pdf_by_area(const Vec3& x, const Vec3& way, const Vec3& y) const {
    const double cosine = -normal_.dot(way);
    return cosine > 0 ? (y - x).squaredNorm() / (area_ * cosine) : 0;
  }
  Emission emission(const Vec3& position, double u, double v) const {
    const Vec3 way = cosine_hemisphere(u, v);
    return {position, normal_,   frame_around(normal_).to_world(way),
            flux(),   1 / area_, cosine_hemisphere_pdf_solid_angle(way.z())};
  }
  LightExtent extent_of(const geometry::Box& box) const {
    return {box, normal_, 1, 0, exitance_.max() * area_ * inv_pi, true};
  }

  Vec3 normal_;
  double area_;
  Spectrum exitance_, radiance_;

 private:
  static constexpr double pays_within2 = 0.25;  ///< square of distance over diameter

  Vec3 centre_;
  double diameter_, reach2_;
};

/// One whose points are drawn uniformly by solid angle where that pays, within half its diameter of its centre, and by
/// area elsewhere, which is sooner done and nearly as good: rays find what is near (docs/lights.md).
///
/// @tparam Shape  has `Vec3 point(u, v) const`, uniform by area; `Seen seen_from(x) const`, with its `solid_angle()`;
///                `std::optional<Arriving> arriving_within(const Seen&, x, u, v) const`, uniform in that
template <class Shape>
class FlatLight : public DiffuseSide {
 public:
  std::optional<Arriving> sample_arriving(const Place& at, double u, double v) const final {
    const Vec3& x = at.position;
    if (!is_before(x)) return std::nullopt;
    if (is_near(x))
      if (const auto seen = shape().seen_from(x); seen.solid_angle() > smallest_solid_angle)
        return shape().arriving_within(seen, x, u, v);
    return arriving_by_area(x, shape().point(u, v));
  }
  double pdf_arriving_solid_angle(const Place& at, const Vec3& way, const Vec3& position) const final {
    const Vec3& x = at.position;
    if (!is_before(x)) return 0;
    if (is_near(x))
      if (const double solid_angle = shape().seen_from(x).solid_angle(); solid_angle > smallest_solid_angle)
        return 1 / solid_angle;
    return pdf_by_area(x, way, position);
  }
  Emission sample_emission(const std::array<double, 4>& u) const final {
    return emission(shape().point(u[0], u[1]), u[2], u[3]);
  }

 protected:
  using DiffuseSide::DiffuseSide;

 private:
  const Shape& shape() const { return static_cast<const Shape&>(*this); }
};

}  // namespace interflect::montecarlo
