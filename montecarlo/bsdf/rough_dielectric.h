#pragma once

#include "montecarlo/bsdf/bsdf.h"
#include "montecarlo/bsdf/cosine_table.h"
#include "montecarlo/bsdf/ggx.h"

namespace interflect::montecarlo {

/// The rough boundary of glass [Walter et al. 2007], i being the light's side whoever asks:
///
///   f_r(i -> o) = F D G2 / (4 cos_i cos_o)
///   f_t(i -> o) = |i.h| |o.h| / (cos_i cos_o)  eta_o² (1 - F) G2 D / (eta_i i.h + eta_o o.h)²,   h ~ -(eta_i i + eta_o o)
///
/// What facets lose by scattering light once, a_s(c) = 1 - E_s(c) of light that arrives on side s, is given back
/// diffusely: of its mean A_s the part x_s passes to the other side t, and 1 - x_s comes back,
///
///   f_ms(i -> o) = a_i(cos_i) w_io a_o(cos_o) / (pi A_o),     w_st = x_s,  w_ss = 1 - x_s,
///   x_s = (1 - F_s) min(A_s, A_t) / A_s
///
/// where F_s is diffuse_fresnel: reciprocal, since (1 - F_s) eta_s² = (1 - F_t) eta_t², and nothing is lost.
class RoughDielectric final : public Bsdf {
 public:
  enum class Scattering : std::uint8_t { single, compensated };
  /// @param eta  index behind the front over that before it
  RoughDielectric(double alpha, double eta, Scattering scattering = Scattering::compensated);

  Spectrum f(const Vec3& from, const Vec3& to) const override;
  double pdf_solid_angle(const Vec3& known, const Vec3& drawn) const override;
  std::optional<Scattered> sample(const Vec3& known, const Vec3& u, Walk walk) const override;
  bool glossy() const override { return true; }
  bool transmits() const override { return true; }

 private:
  /// Of what arrives on a side: 0 the front.
  struct Arriving {
    CosineTable once;  ///< E_s
    double passes;     ///< x_s
  };
  static std::size_t side(const Vec3& way) { return way.z() > 0 ? 0 : 1; }
  double eta_from(const Vec3& way) const { return way.z() > 0 ? eta_ : 1 / eta_; }
  double lost(const Vec3& way) const { return compensated_ ? 1 - arriving_[side(way)].once(std::abs(way.z())) : 0; }
  double to_side(const Vec3& from, const Vec3& to) const {
    const double passes = arriving_[side(from)].passes;
    return side(from) == side(to) ? 1 - passes : passes;
  }
  double once(const Vec3& from, const Vec3& to) const;
  double later(const Vec3& from, const Vec3& to) const;

  Ggx facets_;
  double eta_;
  bool compensated_;
  std::array<Arriving, 2> arriving_;
};

}  // namespace interflect::montecarlo
