#include "montecarlo/light/spot.h"

#include <algorithm>
#include <cmath>

#include "montecarlo/warp/cone.h"

namespace interflect::montecarlo {
namespace {

/// t of 2 t³ - t⁴ = s, which rises from 0 to 1: by Newton's method within a bracket.
double inverse_of_ramp(double s) {
  double low = 0, high = 1, t = std::cbrt(s / 2);
  for (int i = 0; i < 60; ++i) {
    const double error = t * t * t * (2 - t) - s, slope = t * t * (6 - 4 * t);
    (error > 0 ? high : low) = t;
    double next = slope > 0 ? t - error / slope : (low + high) / 2;
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    if (std::abs(next - t) <= 1e-16) return next;
    t = next;
  }
  return t;
}

}  // namespace

Spot::Spot(const scene::SpotLight& light)
    : LightFromPoint(light.position, light.intensity),
      light_(light),
      beam_(1 - light.cos_beam),
      field_(1 - light.cos_field) {}

double Spot::below_one(double u) const {
  const double share = u * (beam_ + field_);  // of the flux, over pi I
  if (share < 2 * beam_ || field_ == beam_) return share / 2;
  const double t = inverse_of_ramp(std::clamp(1 - (share - 2 * beam_) / (field_ - beam_), 0., 1.));
  return field_ - t * (field_ - beam_);
}

Emission Spot::sample_emission(const std::array<double, 4>& u) const {
  const Vec3 way = core::frame_around(light_.direction).to_world(uniform_cone(below_one(u[2]), 1, u[3]));
  return {light_.position, Vec3::Zero(), way, flux(), 1, pdfs_emission(light_.position, way).solid_angle};
}

EmissionPdfs Spot::pdfs_emission(const Vec3&, const Vec3& way) const {
  return {1, light_.falloff(way.dot(light_.direction)) / (pi * (beam_ + field_))};
}

LightExtent Spot::extent() const {
  return {{light_.position, light_.position}, light_.direction, 1, light_.cos_field, light_.intensity.max()};
}

}  // namespace interflect::montecarlo
