#pragma once

#include "montecarlo/bsdf/bsdf.h"
#include "montecarlo/warp.h"

namespace interflect::montecarlo {

/// Diffuse: f = rho / pi on the side where light arrives.
class Lambert final : public Bsdf {
 public:
  explicit Lambert(const Spectrum& reflectance) : reflectance_(reflectance), f_(reflectance * inv_pi) {}

  Spectrum f(const Vec3& from, const Vec3& to) const override { return same_side(from, to) ? f_ : Spectrum::zero(); }
  double pdf_solid_angle(const Vec3& known, const Vec3& drawn) const override {
    return same_side(known, drawn) ? cosine_hemisphere_pdf_solid_angle(std::abs(drawn.z())) : 0;
  }
  std::optional<Scattered> sample(const Vec3& known, const Vec3& u, Walk) const override {
    Vec3 way = cosine_hemisphere(u[1], u[2]);
    const double pdf = cosine_hemisphere_pdf_solid_angle(way.z());
    if (known.z() < 0) way.z() = -way.z();
    return Scattered{way, reflectance_, pdf, false};
  }

 private:
  Spectrum reflectance_, f_;
};

}  // namespace interflect::montecarlo
