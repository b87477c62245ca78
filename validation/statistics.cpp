#include "validation/statistics.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/vec.h"

namespace interflect::validation {

namespace {

double normal_density(double x) { return std::exp(-0.5 * x * x) / std::sqrt(2 * pi); }
double normal_upper_tail(double x) { return 0.5 * std::erfc(x / std::sqrt(2.0)); }

void require_probability(double p) {
  if (!(p > 0 && p < 1)) throw core::PreconditionError("a probability inside (0, 1) expected");
}

}  // namespace

double normal_cdf(double x) { return normal_upper_tail(-x); }

double normal_upper_quantile(double q) {
  require_probability(q);
  if (q > 0.5) return -normal_upper_quantile(1 - q);
  double x = std::sqrt(std::max(0.0, -2 * std::log(2 * q)));
  for (int step = 0; step < 100; ++step) {
    const double tail = normal_upper_tail(x);
    const double change = std::log(tail / q) * tail / normal_density(x);
    x += change;
    if (std::abs(change) <= 1e-15 * (1 + x)) break;
  }
  return x;
}

double normal_quantile(double p) { return -normal_upper_quantile(p); }

double sum_of_squares_quantile(double mean, double variance, double p) {
  if (mean <= 0 || variance <= 0) return std::max(mean, 0.0);
  const double spread = variance / (9 * mean * mean);  // 2 / (9 nu)
  const double root = std::max(0.0, 1 - spread + normal_quantile(p) * std::sqrt(spread));
  return mean * root * root * root;
}

double sidak_level(double alpha, std::size_t comparisons) {
  require_probability(alpha);
  if (comparisons < 1) throw core::PreconditionError("at least one comparison expected");
  return -std::expm1(std::log1p(-alpha) / static_cast<double>(comparisons));
}

double sidak_z_max(double alpha, std::size_t comparisons) {
  return normal_upper_quantile(0.5 * sidak_level(alpha, comparisons));
}

}  // namespace interflect::validation
