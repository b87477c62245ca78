#pragma once

#include "montecarlo/light/light.h"
#include "montecarlo/warp.h"

namespace interflect::montecarlo {

/// Light from far away: its place of departure is drawn on a disk that covers the scene.
class LightFromAfar : public Light {
 public:
  bool is_infinite() const final { return true; }
  LightExtent extent() const final { return {}; }

 protected:
  /// @param box  of the scene; its circumscribed sphere is what the disk covers, with a margin for rounding
  explicit LightFromAfar(const geometry::Box& box)
      : centre_(box.center()), radius_(0.5 * (1 + 1e-6) * box.diagonal().norm()) {}

  double disk_area() const { return pi * radius_ * radius_; }
  /// A particle with the way; the disk touches the sphere behind it.
  Emission emission(const Vec3& way, const Spectrum& weight, double pdf_solid_angle, double u, double v) const {
    const Frame frame = frame_around(way);
    double sine, cosine;
    core::sin_cos_turns(v, sine, cosine);
    const double r = radius_ * std::sqrt(u);
    return {centre_ - radius_ * way + r * (cosine * frame.s + sine * frame.t),
            way,
            way,
            weight,
            1 / disk_area(),
            pdf_solid_angle};
  }
  Arriving arriving(const Vec3& way, const Spectrum& light, double pdf_solid_angle) const {
    return {way, std::numeric_limits<double>::infinity(), Vec3::Zero(), Vec3::Zero(), light, pdf_solid_angle};
  }

 private:
  Vec3 centre_;
  double radius_;
};

}  // namespace interflect::montecarlo
