#include "fem/error_summary.h"

#include <cmath>

namespace interflect::fem {
namespace {

double weigh(const Spectrum& weights, const Spectrum& s) {
  double sum = 0;
  for (int c = 0; c < Spectrum::capacity; ++c)
    if (weights[c] != 0) sum += weights[c] * s[c];
  return sum;
}

}  // namespace

ErrorSummary summarise_error(const RadiositySolution& solution, const Spectrum& weights) {
  double area = 0, mean = 0, squares = 0, bounds = 0, noises = 0;
  for (std::size_t i = 0; i < solution.irradiance.size(); ++i) {
    const double a = solution.mesh.patches()[i].area;
    const double h = weigh(weights, solution.irradiance[i]), bound = weigh(weights, solution.irradiance_error[i]),
                 noise = weigh(weights, solution.irradiance_noise[i]);
    area += a;
    mean += a * h;
    squares += a * h * h;
    bounds += a * bound * bound;
    noises += a * noise * noise;
  }
  if (squares == 0) return {};
  return {mean / area, std::sqrt(bounds / squares), std::sqrt(noises / squares)};
}

}  // namespace interflect::fem
