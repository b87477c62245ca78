#pragma once

#include "montecarlo/bsdf/bsdf.h"
#include "montecarlo/warp.h"

namespace interflect::montecarlo {

/// Diffuse: f = rho / pi on the side where light arrives, or on the front alone, whose back is black.
class Lambert final : public Bsdf {
 public:
  enum class On : std::uint8_t { both_sides, front };
  explicit Lambert(const Spectrum& reflectance, On on = On::both_sides)
      : reflectance_(reflectance), f_(reflectance * inv_pi), front_only_(on == On::front) {}

  Spectrum f(const Vec3& from, const Vec3& to) const override { return reflects(from, to) ? f_ : Spectrum::zero(); }
  double pdf_solid_angle(const Vec3& known, const Vec3& drawn) const override {
    return reflects(known, drawn) ? cosine_hemisphere_pdf_solid_angle(std::abs(drawn.z())) : 0;
  }
  std::optional<Scattered> sample(const Vec3& known, const Vec3& u, Walk) const override {
    if (front_only_ && !(known.z() > 0)) return std::nullopt;
    Vec3 way = cosine_hemisphere(u[1], u[2]);
    const double pdf = cosine_hemisphere_pdf_solid_angle(way.z());
    if (known.z() < 0) way.z() = -way.z();
    return Scattered{way, reflectance_, pdf, false};
  }

 private:
  bool reflects(const Vec3& a, const Vec3& b) const { return same_side(a, b) && (!front_only_ || a.z() > 0); }

  Spectrum reflectance_, f_;
  bool front_only_;
};

}  // namespace interflect::montecarlo
