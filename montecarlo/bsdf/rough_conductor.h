#pragma once

#include "montecarlo/bsdf/bsdf.h"
#include "montecarlo/bsdf/cosine_table.h"
#include "montecarlo/bsdf/ggx.h"
#include "montecarlo/bsdf/metal_fresnel.h"

namespace interflect::montecarlo {

/// A metal whose facets are as ggx.h says:
///
///   f = F(i . h) D(h) G2(i, o) / (4 cos_i cos_o)  +  F_ms (1 - E(i)) (1 - E(o)) / (pi (1 - E_mean))
///
/// E: what facets that reflect everything reflect once; the second part is what they would reflect later [Kulla, Conty
/// 2017], of which F_ms = F_mean² E_mean / (1 - F_mean (1 - E_mean)) is not absorbed.  With F = 1 nothing is lost, to the
/// accuracy of the table of E, 1e-5 from alpha = 0.05 on.
class RoughConductor final : public Bsdf {
 public:
  enum class Scattering : std::uint8_t { single, compensated };
  /// @param alpha  > 0, of the facets' slopes; 1 is as rough as a surface gets
  RoughConductor(double alpha, MetalFresnel fresnel, Scattering scattering = Scattering::compensated);

  Spectrum f(const Vec3& from, const Vec3& to) const override;
  double pdf_solid_angle(const Vec3& known, const Vec3& drawn) const override;
  std::optional<Scattered> sample(const Vec3& known, const Vec3& u, Walk walk) const override;
  bool glossy() const override { return true; }

 private:
  /// Of facets, and of what is diffuse.
  double diffuse_share(double cosine) const { return compensated_ ? 1 - E_(cosine) : 0; }

  Ggx facets_;
  MetalFresnel fresnel_;
  bool compensated_;
  CosineTable E_;
  Spectrum diffuse_;  ///< F_ms / (pi (1 - E_mean))
};

}  // namespace interflect::montecarlo
