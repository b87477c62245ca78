#pragma once

#include <memory>

#include "montecarlo/bsdf/bsdf.h"

namespace interflect::montecarlo {

/// A part of the surface is there, or absorbs where it is nothing, and light passes straight through the rest.
class Mask final : public Bsdf {
 public:
  /// @param opacity  0 .. 1: how much is there
  Mask(double opacity, std::unique_ptr<Bsdf> of) : opacity_(opacity), of_(std::move(of)) {}

  Spectrum f(const Vec3& from, const Vec3& to) const override {
    return of_ ? opacity_ * of_->f(from, to) : Spectrum::zero();
  }
  double pdf_solid_angle(const Vec3& known, const Vec3& drawn) const override {
    return of_ ? opacity_ * of_->pdf_solid_angle(known, drawn) : 0;
  }
  std::optional<Scattered> sample(const Vec3& known, const Vec3& u, Walk walk) const override {
    if (u[0] >= opacity_) return Scattered{-known, Spectrum(1), 0, true, true};
    if (!of_) return std::nullopt;
    std::optional<Scattered> found = of_->sample(known, Vec3(u[0] / opacity_, u[1], u[2]), walk);
    if (found) found->pdf_solid_angle *= opacity_;  // the weight is f / p of both
    return found;
  }
  void delta_parts(const Vec3& known, Walk walk, DeltaParts& parts) const override {
    if (of_) of_->delta_parts(known, walk, parts);
    for (Scattered& each : parts) each.weight *= opacity_;
    if (opacity_ < 1) parts.add({-known, Spectrum(1 - opacity_), 0, true, true});
  }
  Spectrum straight(const Vec3& from) const override {
    return Spectrum(1 - opacity_) + (of_ ? opacity_ * of_->straight(from) : Spectrum::zero());
  }
  bool lets_pass() const override { return true; }
  bool transmits() const override { return of_ && of_->transmits(); }
  bool mirrors() const override { return of_ && of_->mirrors(); }
  bool glossy() const override { return of_ && of_->glossy(); }
  bool only_delta() const override { return opacity_ == 0 || !of_ || of_->only_delta(); }

 private:
  double opacity_;
  std::unique_ptr<Bsdf> of_;
};

/// A surface whose back is black.
class FrontOnly final : public Bsdf {
 public:
  explicit FrontOnly(std::unique_ptr<Bsdf> of) : of_(std::move(of)) {}

  Spectrum f(const Vec3& from, const Vec3& to) const override {
    return from.z() > 0 && to.z() > 0 ? of_->f(from, to) : Spectrum::zero();
  }
  double pdf_solid_angle(const Vec3& known, const Vec3& drawn) const override {
    return known.z() > 0 && drawn.z() > 0 ? of_->pdf_solid_angle(known, drawn) : 0;
  }
  std::optional<Scattered> sample(const Vec3& known, const Vec3& u, Walk walk) const override {
    return known.z() > 0 ? of_->sample(known, u, walk) : std::nullopt;
  }
  void delta_parts(const Vec3& known, Walk walk, DeltaParts& parts) const override {
    if (known.z() > 0) of_->delta_parts(known, walk, parts);
  }
  bool mirrors() const override { return of_->mirrors(); }
  bool glossy() const override { return of_->glossy(); }
  bool only_delta() const override { return of_->only_delta(); }

 private:
  std::unique_ptr<Bsdf> of_;
};

}  // namespace interflect::montecarlo
