#include "montecarlo/bsdf/rough_dielectric.h"

#include <algorithm>

#include "core/fresnel.h"
#include "montecarlo/bsdf/facet_albedo.h"
#include "montecarlo/bsdf/kept_tables.h"
#include "montecarlo/warp.h"

namespace interflect::montecarlo {
namespace {

/// Of light that arrives above, in the parts that it is scattered into.
double scattered_once(const Ggx& facets, double eta, double cosine) {
  return facet_albedo(facets, cosine, [&](const Vec3& v, const Vec3& h) {
    const double c = v.dot(h), F = core::fresnel(c, eta).mean();
    const Vec3 back = core::reflected(v, h);
    const std::optional<Vec3> on = core::refracted(v, h, eta);
    return (back.z() > 0 ? F * facet_weight(facets, v, back) : 0) +
           (on && on->z() < 0 ? (1 - F) * facet_weight(facets, v, *on) : 0);
  });
}

CosineTable table_of(const Ggx& facets, double alpha, double eta, bool compensated) {
  static KeptTables tables;
  if (!compensated) return CosineTable([](double) { return 1; });
  return tables.of({alpha, eta}, [&](double cosine) { return scattered_once(facets, eta, cosine); });
}

Vec3 turned(const Vec3& v, bool over) { return over ? Vec3(v.x(), v.y(), -v.z()) : v; }

/// Halfway between two directions, on the front's side; their sum is of them times the indices on their sides.
Vec3 half_of(const Vec3& a, const Vec3& b, double eta_b) {
  const Vec3 h = same_side(a, b) ? a + b : Vec3(-(a + eta_b * b));
  return h.z() < 0 ? Vec3(-h.normalized()) : h.normalized();
}

}  // namespace

RoughDielectric::RoughDielectric(double alpha, double eta, Scattering scattering)
    : facets_(alpha),
      eta_(eta),
      compensated_(scattering == Scattering::compensated),
      arriving_{Arriving{table_of(facets_, alpha, eta, compensated_), 0},
                Arriving{table_of(facets_, alpha, 1 / eta, compensated_), 0}} {
  const double least = 1 - std::max(arriving_[0].once.mean(), arriving_[1].once.mean());
  if (!(compensated_ && least > 1e-7)) {
    compensated_ = false;  // nothing to speak of
    return;
  }
  for (Arriving& of : arriving_) {
    const double F = core::diffuse_fresnel(&of == arriving_.data() ? eta : 1 / eta);
    of.passes = (1 - F) * least / (1 - of.once.mean());
  }
}

double RoughDielectric::once(const Vec3& from, const Vec3& to) const {
  const double eta = eta_from(from);  // eta_o / eta_i where they are on different sides
  const Vec3 h = half_of(from, to, eta);
  const double i = from.dot(h), o = to.dot(h), cosines = std::abs(from.z() * to.z());
  if (i * from.z() <= 0 || o * to.z() <= 0) return 0;  // the facet's other side
  const double F = core::fresnel(std::abs(i), eta).mean(), DG = facets_.density(h) * facets_.visible(from, to);
  if (same_side(from, to)) return F * DG / (4 * cosines);
  const double across = i + eta * o;
  return std::abs(i * o) / cosines * eta * eta * (1 - F) * DG / (across * across);
}

double RoughDielectric::later(const Vec3& from, const Vec3& to) const {
  if (!compensated_) return 0;
  return lost(from) * to_side(from, to) * lost(to) * inv_pi / (1 - arriving_[side(to)].once.mean());
}

Spectrum RoughDielectric::f(const Vec3& from, const Vec3& to) const {
  if (from.z() == 0 || to.z() == 0) return Spectrum::zero();
  return Spectrum(once(from, to) + later(from, to));
}

double RoughDielectric::pdf_solid_angle(const Vec3& known, const Vec3& drawn) const {
  if (known.z() == 0 || drawn.z() == 0) return 0;
  const bool below = known.z() < 0;
  const Vec3 k = turned(known, below), s = turned(drawn, below);
  const double eta = eta_from(known), diffuse = lost(known);
  const Vec3 h = half_of(k, s, eta);
  const double kh = k.dot(h), sh = s.dot(h);
  double by_facet = 0;
  if (kh > 0 && sh * s.z() > 0) {
    const double F = core::fresnel(kh, eta).mean(), across = kh + eta * sh;
    by_facet = facets_.pdf_solid_angle(k, h) *
               (s.z() > 0 ? F / (4 * kh) : (1 - F) * eta * eta * std::abs(sh) / (across * across));
  }
  return (1 - diffuse) * by_facet +
         diffuse * to_side(known, drawn) * cosine_hemisphere_pdf_solid_angle(std::abs(drawn.z()));
}

std::optional<Scattered> RoughDielectric::sample(const Vec3& known, const Vec3& u, Walk walk) const {
  if (known.z() == 0) return std::nullopt;
  const bool below = known.z() < 0;
  const Vec3 k = turned(known, below);
  const double eta = eta_from(known), diffuse = lost(known);
  std::optional<Vec3> way;
  if (u[0] < diffuse) {
    way = cosine_hemisphere(u[1], u[2]);
    if (u[0] < diffuse * arriving_[side(known)].passes) way->z() = -way->z();
  } else {
    const Vec3 h = facets_.sample(k, u[1], u[2]);
    const double F = core::fresnel(k.dot(h), eta).mean(), part = (u[0] - diffuse) / (1 - diffuse);
    const bool back = part < F;
    way = back ? std::optional(core::reflected(k, h)) : core::refracted(k, h, eta);
    if (!way || (way->z() > 0) != back) return std::nullopt;
  }
  std::optional<Scattered> found = scattered(*this, known, turned(*way, below), walk);
  if (found && walk == Walk::from_eye && !same_side(known, found->way)) found->squeezed = 1 / (eta * eta);
  return found;
}

}  // namespace interflect::montecarlo
