#include "core/convergence_slope.h"

#include <cmath>

#include "core/error.h"
#include "core/moments.h"
#include "core/student_t.h"

namespace interflect::core {
namespace {

constexpr std::size_t none = ~std::size_t{0};

/// Of each n, over all randomisations but one.
std::vector<double> errors(std::span<const std::vector<double>> means, std::size_t sizes, std::size_t without) {
  std::vector<double> rmse;
  for (std::size_t k = 0; k < sizes; ++k) {
    ScalarMoments moments;
    for (std::size_t r = 0; r < means.size(); ++r)
      if (r != without) moments.add(means[r][k]);
    rmse.push_back(std::sqrt(moments.variance()));
  }
  return rmse;
}

double fitted(std::span<const std::uint64_t> samples, std::span<const double> rmse) {
  double mean_x = 0, xx = 0, xy = 0;
  const auto x = [&](std::size_t k) { return std::log(static_cast<double>(samples[k])); };
  for (std::size_t k = 0; k < samples.size(); ++k) mean_x += x(k) / static_cast<double>(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double d = x(k) - mean_x;
    xx += d * d;
    xy += d * std::log(rmse[k]);
  }
  return xy / xx;
}

}  // namespace

double ConvergenceSlope::half_width(double confidence) const {
  return student_t(confidence, degrees_of_freedom) * standard_error;
}

ConvergenceSlope convergence_slope(std::span<const std::uint64_t> samples, std::span<const std::vector<double>> means) {
  if (samples.size() < 2 || means.size() < 3)
    throw PreconditionError("convergence slope: two numbers of samples and three randomisations expected");
  ScalarMoments without_one;
  for (std::size_t r = 0; r < means.size(); ++r) without_one.add(fitted(samples, errors(means, samples.size(), r)));
  std::vector<double> rmse = errors(means, samples.size(), none);
  const double slope = fitted(samples, rmse), others = static_cast<double>(means.size() - 1);
  return {std::move(rmse), slope,
          std::sqrt(others / static_cast<double>(means.size()) * without_one.squared_deviations()),
          static_cast<int>(means.size()) - 1};
}

}  // namespace interflect::core
