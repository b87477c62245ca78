#include "montecarlo/bsdf/plastic.h"

#include "core/fresnel.h"
#include "montecarlo/warp.h"

namespace interflect::montecarlo {

Plastic::Plastic(double eta, const Spectrum& reflectance) : eta_(eta) {
  const double inside = core::diffuse_fresnel(1 / eta);
  base_ = reflectance.map([&](double rho) { return rho / (pi * eta * eta * (1 - rho * inside)); });
  albedo_ = reflectance.map([&](double rho) { return rho * (1 - inside) / (1 - rho * inside); }).max();
}

double Plastic::coat(double cosine) const {
  const double F = core::fresnel(cosine, eta_).mean();
  return F / (F + (1 - F) * albedo_);
}

Spectrum Plastic::f(const Vec3& from, const Vec3& to) const {
  if (!same_side(from, to)) return Spectrum::zero();
  const auto passes = [&](const Vec3& way) { return 1 - core::fresnel(std::abs(way.z()), eta_).mean(); };
  return base_ * (passes(from) * passes(to));
}

double Plastic::pdf_solid_angle(const Vec3& known, const Vec3& drawn) const {
  if (!same_side(known, drawn)) return 0;
  return (1 - coat(std::abs(known.z()))) * cosine_hemisphere_pdf_solid_angle(std::abs(drawn.z()));
}

std::optional<Scattered> Plastic::sample(const Vec3& known, const Vec3& u, Walk walk) const {
  const double cosine = std::abs(known.z()), by_coat = coat(cosine);
  if (u[0] < by_coat)
    return Scattered{Vec3(-known.x(), -known.y(), known.z()), Spectrum(core::fresnel(cosine, eta_).mean() / by_coat), 0,
                     true};
  Vec3 way = cosine_hemisphere(u[1], u[2]);
  if (known.z() < 0) way.z() = -way.z();
  return scattered(*this, known, way, walk);
}

void Plastic::delta_parts(const Vec3& known, Walk, DeltaParts& parts) const {
  const double F = core::fresnel(std::abs(known.z()), eta_).mean();
  parts.add({Vec3(-known.x(), -known.y(), known.z()), Spectrum(F), 0, true});
}

}  // namespace interflect::montecarlo
