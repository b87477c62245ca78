#pragma once

#include <algorithm>

#include "core/fresnel.h"
#include "montecarlo/bsdf/bsdf.h"
#include "montecarlo/bsdf/metal_fresnel.h"

/// Smooth boundaries: all they do is delta.
namespace interflect::montecarlo {

class SmoothBsdf : public Bsdf {
 public:
  Spectrum f(const Vec3&, const Vec3&) const final { return Spectrum::zero(); }
  double pdf_solid_angle(const Vec3&, const Vec3&) const final { return 0; }
  bool only_delta() const final { return true; }

 protected:
  static Vec3 mirrored(const Vec3& way) { return {-way.x(), -way.y(), way.z()}; }
  static Scattered to(const Vec3& way, const Spectrum& weight) { return {way, weight, 0, true}; }
};

/// Reflects the same part at any angle, on both sides.
class Mirror final : public SmoothBsdf {
 public:
  explicit Mirror(const Spectrum& reflectance) : reflectance_(reflectance) {}
  std::optional<Scattered> sample(const Vec3& known, const Vec3&, Walk) const override {
    return to(mirrored(known), reflectance_);
  }
  void delta_parts(const Vec3& known, Walk, DeltaParts& parts) const override {
    parts.add(to(mirrored(known), reflectance_));
  }

 private:
  Spectrum reflectance_;
};

/// A mirror of metal.
class PolishedMetal final : public SmoothBsdf {
 public:
  explicit PolishedMetal(MetalFresnel fresnel) : fresnel_(std::move(fresnel)) {}
  std::optional<Scattered> sample(const Vec3& known, const Vec3&, Walk) const override {
    return to(mirrored(known), fresnel_(std::abs(known.z())));
  }
  void delta_parts(const Vec3& known, Walk, DeltaParts& parts) const override {
    parts.add(to(mirrored(known), fresnel_(std::abs(known.z()))));
  }

 private:
  MetalFresnel fresnel_;
};

/// The boundary of glass or water: reflects F, and refracts 1 - F.
///
/// Of refracted light the radiance is L_o = (1 - F) L_i (eta_o / eta_i)², since it is squeezed into fewer directions:
/// a walk from the eye has that factor, one from a light, which carries flux, has not.
class Dielectric final : public SmoothBsdf {
 public:
  /// @param eta  index behind the front over that before it: 1.5 of glass whose outside is the front
  explicit Dielectric(double eta) : eta_(eta) {}
  std::optional<Scattered> sample(const Vec3& known, const Vec3& u, Walk walk) const override {
    const double eta = known.z() > 0 ? eta_ : 1 / eta_, F = core::fresnel(std::abs(known.z()), eta).mean();
    return u[0] < F ? to(mirrored(known), Spectrum(1)) : refracted(known, eta, walk);
  }
  void delta_parts(const Vec3& known, Walk walk, DeltaParts& parts) const override {
    const double eta = known.z() > 0 ? eta_ : 1 / eta_, F = core::fresnel(std::abs(known.z()), eta).mean();
    parts.add(to(mirrored(known), Spectrum(F)));
    if (F == 1) return;
    if (auto passes = refracted(known, eta, walk)) passes->weight *= 1 - F, parts.add(*passes);
  }

 private:
  static std::optional<Scattered> refracted(const Vec3& known, double eta, Walk walk) {
    const std::optional<Vec3> way = core::refracted(known, Vec3::UnitZ(), eta);
    if (!way) return std::nullopt;
    Scattered passes = to(*way, Spectrum(1));
    if (walk == Walk::from_eye) passes.squeezed = 1 / (eta * eta), passes.weight *= passes.squeezed;
    return passes;
  }

  double eta_;
};

/// A thin pane (core::Pane), one a channel: reflects, or lets pass straight on.
class ThinPane final : public SmoothBsdf {
 public:
  /// @param transmittance  at normal incidence, a channel; no more than glass of this index lets pass
  ThinPane(double eta, const Spectrum& transmittance) {
    for (int c = 0; c < Spectrum::capacity; ++c)
      of_[static_cast<std::size_t>(c)] = core::Pane::of(eta, transmittance[c]);
  }
  std::optional<Scattered> sample(const Vec3& known, const Vec3& u, Walk) const override {
    Spectrum R, T;
    set_parts(std::abs(known.z()), R, T);
    if (R.is_zero() && T.is_zero()) return std::nullopt;
    const double both = R.max() + T.max();
    if (u[0] < R.max() / both) return to(mirrored(known), R * (both / R.max()));
    return through(known, T * (both / T.max()));
  }
  void delta_parts(const Vec3& known, Walk, DeltaParts& parts) const override {
    Spectrum R, T;
    set_parts(std::abs(known.z()), R, T);
    if (!R.is_zero()) parts.add(to(mirrored(known), R));
    if (!T.is_zero()) parts.add(through(known, T));
  }
  Spectrum straight(const Vec3& from) const override {
    Spectrum R, T;
    set_parts(std::abs(from.z()), R, T);
    return T;
  }
  bool lets_pass() const override { return true; }

 private:
  static Scattered through(const Vec3& known, const Spectrum& weight) {
    Scattered on = to(-known, weight);
    on.straight = true;
    return on;
  }
  void set_parts(double cosine, Spectrum& R, Spectrum& T) const {
    for (int c = 0; c < Spectrum::capacity; ++c) {
      const core::Pane::Parts parts = of_[static_cast<std::size_t>(c)](cosine);
      R[c] = parts.reflected, T[c] = parts.transmitted;
    }
  }
  std::array<core::Pane, Spectrum::capacity> of_;
};

}  // namespace interflect::montecarlo
