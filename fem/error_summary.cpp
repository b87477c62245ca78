#include "fem/error_summary.h"

#include <algorithm>
#include <cmath>

#include "core/estimate.h"

namespace interflect::fem {

ErrorSummary summarise_error(const RadiositySolution& solution, const scene::Scene& scene) {
  Spectrum own(0.0);  // variance of sum A H
  double area = 0, mean = 0, mean_bound = 0, squares = 0, bounds = 0, noises = 0;
  for (std::size_t i = 0; i < solution.irradiance.size(); ++i) {
    const double a = solution.mesh.patches()[i].area;
    const double h = scene.weigh(solution.irradiance[i]), bound = scene.weigh(solution.irradiance_error[i]),
                 noise = scene.weigh(solution.irradiance_noise[i]);
    area += a;
    mean_bound += a * bound;
    own += a * a * solution.own_variance(i);
    mean += a * h;
    squares += a * h * h;
    bounds += a * bound * bound;
    noises += a * noise * noise;
  }
  if (squares == 0) return {};
  Spectrum mean_noise;
  for (int c = 0; c < scene.channel_count(); ++c)
    mean_noise[c] = solution.shared_noise[c] + std::sqrt(2 * std::max(0.0, own[c])) / area;
  return {mean / area, mean_bound / area + normal_95 * scene.weigh(mean_noise), std::sqrt(bounds / squares),
          std::sqrt(noises / squares)};
}

}  // namespace interflect::fem
