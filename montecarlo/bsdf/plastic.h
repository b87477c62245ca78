#pragma once

#include "montecarlo/bsdf/bsdf.h"

namespace interflect::montecarlo {

/// A smooth clear coat over a diffuse base, with all that goes back and forth between them:
///
///   f = F delta + (1 - F(i)) (1 - F(o)) rho / (pi n² (1 - rho F_i)),   F_i = diffuse_fresnel(1 / n)
///
/// With rho = 1 nothing is lost.
class Plastic final : public Bsdf {
 public:
  Plastic(double eta, const Spectrum& reflectance);

  Spectrum f(const Vec3& from, const Vec3& to) const override;
  double pdf_solid_angle(const Vec3& known, const Vec3& drawn) const override;
  std::optional<Scattered> sample(const Vec3& known, const Vec3& u, Walk walk) const override;
  void delta_parts(const Vec3& known, Walk walk, DeltaParts& parts) const override;
  bool mirrors() const override { return true; }

 private:
  double coat(double cosine) const;  ///< how likely it is drawn

  double eta_;
  Spectrum base_;  ///< rho / (pi n² (1 - rho F_i))
  double albedo_;  ///< of light that has passed the coat, what comes out again, of the brightest channel
};

}  // namespace interflect::montecarlo
