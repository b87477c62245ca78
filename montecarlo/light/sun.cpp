#include "montecarlo/light/sun.h"

#include "montecarlo/warp/cone.h"

namespace interflect::montecarlo {

SunLight::SunLight(const scene::Sun& sun, const geometry::Box& box)
    : LightFromAfar(box),
      sun_(sun),
      towards_(frame_around(-sun.direction)),
      cone_(sun.one_minus_cosine()),
      radiance_(cone_ > 0 ? sun.radiance() : Spectrum::zero()),
      perpendicular_(cone_ > 0 ? radiance_ * (2 * pi * cone_) : sun.irradiance) {}

Spectrum SunLight::flux() const { return disk_area() * perpendicular_; }

std::optional<Arriving> SunLight::sample_arriving(const Place&, double u, double v) const {
  if (cone_ == 0) return arriving(towards_.n, sun_.irradiance, 0);
  return arriving(towards_.to_world(uniform_cone(cone_, u, v)), radiance_, uniform_cone_pdf_solid_angle(cone_));
}

double SunLight::pdf_arriving_solid_angle(const Place&, const Vec3& way, const Vec3&) const {
  return cone_ > 0 && sun_.shines_from(way) ? uniform_cone_pdf_solid_angle(cone_) : 0;
}

Emission SunLight::sample_emission(const std::array<double, 4>& u) const {
  const Vec3 way = cone_ > 0 ? Vec3(-towards_.to_world(uniform_cone(cone_, u[2], u[3]))) : sun_.direction;
  return emission(way, flux(), cone_ > 0 ? uniform_cone_pdf_solid_angle(cone_) : 1, u[0], u[1]);
}

EmissionPdfs SunLight::pdfs_emission(const Vec3&, const Vec3& way) const {
  if (cone_ == 0) return {1 / disk_area(), 1};
  return {1 / disk_area(), sun_.shines_from(-way) ? uniform_cone_pdf_solid_angle(cone_) : 0};
}

Spectrum SunLight::radiance(const Vec3&, const Vec3& way) const {
  return cone_ > 0 && sun_.shines_from(-way) ? radiance_ : Spectrum::zero();
}

}  // namespace interflect::montecarlo
