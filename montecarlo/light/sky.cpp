#include "montecarlo/light/sky.h"

#include "montecarlo/warp/cone.h"

namespace interflect::montecarlo {

SkyLight::SkyLight(const scene::Sky& sky, const geometry::Box& box)
    : LightFromAfar(box), sky_(sky), up_(frame_around(sky.up)), cone_(sky.ground.is_zero() ? 1 : 2) {}

std::optional<Arriving> SkyLight::sample_arriving(const Place& at, double u, double v) const {
  Vec3 way;
  if (at.normal.isZero())
    way = uniform_cone(2, u, v);
  else
    way = frame_around(at.normal).to_world(cosine_hemisphere(u, v));
  const double pdf = pdf_arriving_solid_angle(at, way, Vec3::Zero());
  const Spectrum& seen = sky_.seen(way);
  if (seen.is_zero() || !(pdf > 0)) return std::nullopt;
  return arriving(way, seen, pdf);
}

double SkyLight::pdf_arriving_solid_angle(const Place& at, const Vec3& way, const Vec3&) const {
  if (at.normal.isZero()) return uniform_cone_pdf_solid_angle(2);
  return cosine_hemisphere_pdf_solid_angle(at.normal.dot(way));
}

Emission SkyLight::sample_emission(const std::array<double, 4>& u) const {
  const Vec3 from = up_.to_world(uniform_cone(cone_, u[2], u[3]));
  const double pdf = uniform_cone_pdf_solid_angle(cone_);
  return emission(-from, sky_.seen(from) * (disk_area() / pdf), pdf, u[0], u[1]);
}

EmissionPdfs SkyLight::pdfs_emission(const Vec3&, const Vec3& way) const {
  const bool drawn = cone_ == 2 || -way.dot(sky_.up) > 0;
  return {1 / disk_area(), drawn ? uniform_cone_pdf_solid_angle(cone_) : 0};
}

}  // namespace interflect::montecarlo
