#include "montecarlo/light/sphere.h"

#include "montecarlo/warp.h"
#include "montecarlo/warp/cone.h"

namespace interflect::montecarlo {

std::optional<double> BallLight::cone_from(const Vec3& x) const {
  const double s2 = light_.radius * light_.radius / (light_.centre - x).squaredNorm();
  if (!(s2 < 1)) return std::nullopt;
  return s2 / (1 + std::sqrt(1 - s2));
}

std::optional<Arriving> BallLight::sample_arriving(const Place& at, double u, double v) const {
  const std::optional<double> cone = cone_from(at.position);
  if (!cone) return std::nullopt;
  const Vec3 to_centre = light_.centre - at.position;
  const double d = to_centre.norm();
  const Vec3 local = uniform_cone(*cone, u, v), way = frame_around(to_centre / d).to_world(local);
  const double beside2 = d * d * (local.x() * local.x() + local.y() * local.y());  // of the ray, from the centre
  const double r = d * local.z() - std::sqrt(std::max(0., light_.radius * light_.radius - beside2));
  const Vec3 normal = (at.position + r * way - light_.centre).normalized();
  return Arriving{way,
                  r,
                  light_.centre + light_.radius * normal,
                  normal,
                  light_.exitance * inv_pi,
                  uniform_cone_pdf_solid_angle(*cone)};
}

double BallLight::pdf_arriving_solid_angle(const Place& at, const Vec3&, const Vec3&) const {
  const std::optional<double> cone = cone_from(at.position);
  return cone ? uniform_cone_pdf_solid_angle(*cone) : 0;
}

Emission BallLight::sample_emission(const std::array<double, 4>& u) const {
  const Vec3 normal = uniform_cone(2, u[0], u[1]), way = cosine_hemisphere(u[2], u[3]);
  return {
      light_.centre + light_.radius * normal,    normal, frame_around(normal).to_world(way), flux(), 1 / light_.area(),
      cosine_hemisphere_pdf_solid_angle(way.z())};
}

EmissionPdfs BallLight::pdfs_emission(const Vec3& position, const Vec3& way) const {
  return {1 / light_.area(), cosine_hemisphere_pdf_solid_angle((position - light_.centre).dot(way) / light_.radius)};
}

Spectrum BallLight::radiance(const Vec3& position, const Vec3& way) const {
  return (position - light_.centre).dot(way) > 0 ? light_.exitance * inv_pi : Spectrum::zero();
}

LightExtent BallLight::extent() const {
  const Vec3 r = Vec3::Constant(light_.radius);
  return {{light_.centre - r, light_.centre + r},
          Vec3::UnitZ(),
          -1,
          0,
          light_.exitance.max() * light_.radius * light_.radius};
}

}  // namespace interflect::montecarlo
