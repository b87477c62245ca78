#pragma once

#include <cmath>

#include "montecarlo/light/light.h"

namespace interflect::montecarlo {

/// Light from a point: H = I(way) / d² perpendicular to the way.
class LightFromPoint : public Light {
 public:
  std::optional<Arriving> sample_arriving(const Place& at, double, double) const final {
    const Vec3 way = position_ - at.position;
    const double square = way.squaredNorm(), r = std::sqrt(square);
    if (!(r > 0)) return std::nullopt;
    const double part = part_of_intensity(-way / r);
    if (!(part > 0)) return std::nullopt;
    return Arriving{way / r, r, position_, Vec3::Zero(), intensity_ * (part / square), 0};
  }
  double pdf_arriving_solid_angle(const Place&, const Vec3&, const Vec3&) const final { return 0; }
  Spectrum radiance(const Vec3&, const Vec3&) const final { return Spectrum::zero(); }
  LargestFind largest_find(double from) const final { return {Spectrum(infinite), intensity_ / (from * from)}; }
  bool is_delta_position() const final { return true; }

 protected:
  /// @param intensity  the largest [W/sr | cd]
  LightFromPoint(const Vec3& position, const Spectrum& intensity) : position_(position), intensity_(intensity) {}

 private:
  /// Of the way that light goes, 0 .. 1.
  virtual double part_of_intensity(const Vec3& way) const = 0;

  Vec3 position_;
  Spectrum intensity_;
};

}  // namespace interflect::montecarlo
