#include "core/fresnel.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace interflect::core {
namespace {

double squared(double x) { return x * x; }

}  // namespace

std::optional<double> refracted_cosine(double cosine, double eta) {
  const double square = 1 - (1 - cosine * cosine) / (eta * eta);
  if (!(square >= 0)) return std::nullopt;
  return std::sqrt(square);
}

Polarised fresnel(double cosine, double eta) {
  const std::optional<double> behind = refracted_cosine(cosine, eta);
  if (!behind) return {1, 1};
  const double c = cosine, t = *behind;
  if (c + t == 0) return {1, 1};  // grazing, between equal media: the limit of others
  return {squared((c - eta * t) / (c + eta * t)), squared((eta * c - t) / (eta * c + t))};
}

Polarised fresnel(double cosine, double eta, double k) {
  const std::complex<double> index(eta, k), square = index * index;
  const std::complex<double> t = std::sqrt(square - (1 - cosine * cosine));  // index times the refracted cosine
  return {std::norm((cosine - t) / (cosine + t)), std::norm((square * cosine - t) / (square * cosine + t))};
}

/// In sqrt(c - c_critical), which R is smooth in; beyond the critical angle it is 1.
double diffuse_fresnel(double eta) {
  constexpr int n = 1000;  // Simpson's rule
  const double critical = eta < 1 ? std::sqrt(1 - eta * eta) : 0;
  double sum = 0;
  for (int k = 0; k <= n; ++k) {
    const double x = static_cast<double>(k) / n, c = critical + (1 - critical) * x * x;
    const double weight = k == 0 || k == n ? 1 : k % 2 == 1 ? 4 : 2;
    sum += weight * fresnel(c, eta).mean() * 2 * c * 2 * x * (1 - critical);
  }
  return sum / (3 * n) + critical * critical;
}

Pane::Parts Pane::operator()(double cosine) const {
  const std::optional<double> inside = refracted_cosine(cosine, eta);
  if (!inside || normal_pass <= 0) return {fresnel(cosine, eta).mean(), 0};
  const double tau = std::pow(normal_pass, 1 / *inside);
  const Polarised r = fresnel(cosine, eta);
  const auto transmitted = [&](double r_of) {
    const double loops = 1 - r_of * r_of * tau * tau;
    return loops > 0 ? tau * squared(1 - r_of) / loops : 0;
  };
  const auto reflected_part = [&](double r_of) { return r_of + r_of * tau * transmitted(r_of); };
  return {Polarised{reflected_part(r.s), reflected_part(r.p)}.mean(),
          Polarised{transmitted(r.s), transmitted(r.p)}.mean()};
}

/// T = tau (1 - r)² / (1 - r² tau²), solved for tau:  T r² tau² + (1 - r)² tau - T = 0.
Pane Pane::of(double eta, double transmittance) {
  const double r = fresnel(1, eta).mean(), b = squared(1 - r), T = transmittance;
  return {eta, std::min(1.0, 2 * T / (b + std::sqrt(b * b + 4 * T * T * r * r)))};
}

std::optional<Vec3> refracted(const Vec3& way, const Vec3& normal, double eta) {
  const double c = normal.dot(way);
  const std::optional<double> behind = refracted_cosine(std::abs(c), eta);
  if (!behind) return std::nullopt;
  const Vec3 n = c < 0 ? Vec3(-normal) : normal;
  return Vec3((std::abs(c) / eta - *behind) * n - way / eta);
}

}  // namespace interflect::core
