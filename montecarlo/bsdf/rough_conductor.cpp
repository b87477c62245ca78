#include "montecarlo/bsdf/rough_conductor.h"

#include "core/fresnel.h"
#include "montecarlo/bsdf/facet_albedo.h"
#include "montecarlo/bsdf/kept_tables.h"
#include "montecarlo/warp.h"

namespace interflect::montecarlo {
namespace {

double reflected_once(const Ggx& facets, double cosine) {
  return facet_albedo(facets, cosine, [&](const Vec3& v, const Vec3& h) {
    const Vec3 way = core::reflected(v, h);
    return way.z() > 0 ? facet_weight(facets, v, way) : 0;
  });
}

CosineTable table_of(const Ggx& facets, double alpha, bool compensated) {
  static KeptTables tables;
  if (!compensated) return CosineTable([](double) { return 1; });
  return tables.of({alpha, 0}, [&](double cosine) { return reflected_once(facets, cosine); });
}

Vec3 up(Vec3 v) {
  if (v.z() < 0) v.z() = -v.z();
  return v;
}

}  // namespace

RoughConductor::RoughConductor(double alpha, MetalFresnel fresnel, Scattering scattering)
    : facets_(alpha),
      fresnel_(std::move(fresnel)),
      compensated_(scattering == Scattering::compensated),
      E_(table_of(facets_, alpha, compensated_)) {
  const double lost = 1 - E_.mean();
  if (!(compensated_ && lost > 1e-7)) {
    compensated_ = false;  // nothing to speak of
    return;
  }
  diffuse_ = fresnel_.mean().map([&](double F) { return F * F * E_.mean() / (1 - F * lost) / (pi * lost); });
}

Spectrum RoughConductor::f(const Vec3& from, const Vec3& to) const {
  if (!same_side(from, to)) return Spectrum::zero();
  const Vec3 i = up(from), o = up(to), h = (i + o).normalized();
  const Spectrum once = fresnel_(i.dot(h)) * (facets_.density(h) * facets_.visible(i, o) / (4 * i.z() * o.z()));
  return once + diffuse_ * (diffuse_share(i.z()) * diffuse_share(o.z()));
}

double RoughConductor::pdf_solid_angle(const Vec3& known, const Vec3& drawn) const {
  if (!same_side(known, drawn)) return 0;
  const Vec3 k = up(known), s = up(drawn), h = (k + s).normalized();
  const double diffuse = diffuse_share(k.z());
  return (1 - diffuse) * facets_.pdf_solid_angle(k, h) / (4 * k.dot(h)) +
         diffuse * cosine_hemisphere_pdf_solid_angle(s.z());
}

std::optional<Scattered> RoughConductor::sample(const Vec3& known, const Vec3& u, Walk walk) const {
  const Vec3 k = up(known);
  Vec3 way =
      u[0] < diffuse_share(k.z()) ? cosine_hemisphere(u[1], u[2]) : core::reflected(k, facets_.sample(k, u[1], u[2]));
  if (!(way.z() > 0)) return std::nullopt;
  if (known.z() < 0) way.z() = -way.z();
  return scattered(*this, known, way, walk);
}

}  // namespace interflect::montecarlo
