#include "fem/error_summary.h"

#include <cmath>

#include "core/estimate.h"
#include "fem/sum_noise.h"

namespace interflect::fem {

ErrorSummary summarise_error(const RadiositySolution& solution, const scene::Scene& scene) {
  SumNoise of_sum(solution);
  double area = 0, mean = 0, mean_bound = 0, squares = 0, bounds = 0, noises = 0;
  for (std::size_t i = 0; i < solution.irradiance.size(); ++i) {
    const double a = solution.mesh.patches()[i].area;
    const double h = scene.weigh(solution.irradiance[i]), bound = scene.weigh(solution.irradiance_error[i]),
                 noise = scene.weigh(solution.irradiance_noise[i]);
    area += a;
    mean_bound += a * bound;
    of_sum.add(i, Spectrum(a));
    mean += a * h;
    squares += a * h * h;
    bounds += a * bound * bound;
    noises += a * noise * noise;
  }
  if (squares == 0) return {};
  return {mean / area, (mean_bound + normal_95 * scene.weigh(of_sum.together())) / area, std::sqrt(bounds / squares),
          std::sqrt(noises / squares)};
}

ErrorShares shares_of_error(const RadiositySolution& solution, const scene::Scene& scene, const Spectrum& missing) {
  const double unshot = scene.weigh(missing);
  double area = 0, rests = 0, squares = 0;
  for (std::size_t i = 0; i < solution.irradiance.size(); ++i) {
    const double a = solution.mesh.patches()[i].area, h = scene.weigh(solution.irradiance[i]),
                 rest = scene.weigh(solution.irradiance_error[i]) - unshot;
    area += a;
    rests += a * rest * rest;
    squares += a * h * h;
  }
  if (squares == 0) return {};
  return {unshot * std::sqrt(area / squares), std::sqrt(rests / squares)};
}

}  // namespace interflect::fem
