#pragma once

#include <cmath>

#include "core/random.h"
#include "montecarlo/bsdf/bsdf.h"

/// Ways, numbers, and what comes of them on average.
namespace interflect::test {

/// A way of that cosine.
inline Vec3 at(double cosine, double azimuth = 0) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}
/// The cosine of so many degrees.
inline double degrees(double angle) { return std::cos(angle * pi / 180); }

/// In [0, 1), for each k of each stream.
inline Vec3 three_numbers(std::uint32_t stream, std::uint64_t k) {
  core::RandomNumbers numbers(7, stream, k);
  const double a = numbers.next(), b = numbers.next(), c = numbers.next();
  return {a, b, c};
}

/// The mean of a function of the numbers that a direction is drawn by over midpoints of them, which are closer together
/// where facets are steepest.
template <class Score>
double mean_over_numbers(const Score& score, int lobes, int n) {
  double sum = 0;
  for (int a = 0; a < n; ++a) {
    const double left = 1 - (a + .5) / n;
    for (int b = 0; b < n; ++b)
      for (int l = 0; l < lobes; ++l)
        sum += 3 * left * left * score(Vec3((l + .5) / lobes, 1 - left * left * left, (b + .5) / n));
  }
  return sum / lobes / n / n;
}
/// The same of the direction and weight, 0 where none is drawn.
template <class Score>
double mean_over_draws(const montecarlo::Bsdf& bsdf, const Vec3& known, montecarlo::Walk walk, const Score& score,
                       int lobes = 64, int n = 48) {
  return mean_over_numbers(
      [&](const Vec3& u) {
        const auto s = bsdf.sample(known, u, walk);
        return s ? score(s->way, s->weight[0]) : 0;
      },
      lobes, n);
}
inline double albedo(const montecarlo::Bsdf& bsdf, const Vec3& known,
                     montecarlo::Walk walk = montecarlo::Walk::from_light) {
  return mean_over_draws(bsdf, known, walk, [](const Vec3&, double weight) { return weight; });
}

/// int f(known -> o) |cos_o| over a side, by midpoints in azimuth and sqrt(1 - cosine), which see a peak at the normal.
inline double flux_to(const montecarlo::Bsdf& bsdf, const Vec3& known, double side) {
  constexpr int n = 500;
  double sum = 0;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      const double x = (a + .5) / n, c = 1 - x * x;
      sum += bsdf.f(known, at(side * c, pi * (b + .5) / n))[0] * c * 2 * x;  // symmetric about the plane of incidence
    }
  return sum * 2 * pi / n / n;
}

}  // namespace interflect::test
