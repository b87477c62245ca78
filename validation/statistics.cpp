#include "validation/statistics.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/vec.h"

namespace interflect::validation {

namespace {

constexpr std::size_t large_degrees = 10000;

double normal_density(double x) { return std::exp(-0.5 * x * x) / std::sqrt(2 * pi); }
double normal_upper_tail(double x) { return 0.5 * std::erfc(x / std::sqrt(2.0)); }

/// Gamma((nu + 1)/2) / (sqrt(nu pi) Gamma(nu/2)) (1 + t²/nu)^(-(nu + 1)/2)
double student_t_density(double t, double nu) {
  const double log_scale = std::lgamma(0.5 * (nu + 1)) - std::lgamma(0.5 * nu) - 0.5 * std::log(nu * pi);
  return std::exp(log_scale - 0.5 * (nu + 1) * std::log1p(t * t / nu));
}

/// P(|T| <= t), t >= 0.
double student_t_within(double t, std::size_t degrees) {
  const auto nu = static_cast<double>(degrees);
  const double cos2 = nu / (nu + t * t), sine = t / std::sqrt(nu + t * t);
  const bool odd = degrees % 2 == 1;
  double sum = 0, term = odd ? std::sqrt(cos2) : 1.0;
  for (std::size_t power = odd ? 1 : 0; power + 2 <= degrees; power += 2) {
    sum += term;
    term *= cos2 * static_cast<double>(power + 1) / static_cast<double>(power + 2);
  }
  return odd ? 2 * inv_pi * (std::atan(t / std::sqrt(nu)) + sine * sum) : sine * sum;
}

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

double student_t_cdf(double t, std::size_t degrees) {
  if (degrees < 1) throw core::PreconditionError("at least one degree of freedom expected");
  if (degrees <= large_degrees) return 0.5 + std::copysign(0.5 * student_t_within(std::abs(t), degrees), t);
  const auto nu = static_cast<double>(degrees);  // the inverse of student_t_quantile's series, to the same order
  const double z = t - (t * t * t + t) / (4 * nu) + (13 * std::pow(t, 5) + 8 * t * t * t + 3 * t) / (96 * nu * nu);
  return normal_cdf(z);
}

double student_t_quantile(double p, std::size_t degrees) {
  require_probability(p);
  if (degrees < 1) throw core::PreconditionError("at least one degree of freedom expected");
  if (p < 0.5) return -student_t_quantile(1 - p, degrees);
  const auto nu = static_cast<double>(degrees);
  if (degrees > large_degrees) {
    const double z = normal_quantile(p);
    return z + (z * z * z + z) / (4 * nu) + (5 * std::pow(z, 5) + 16 * z * z * z + 3 * z) / (96 * nu * nu);
  }
  double t = 0;  // the distribution is concave for t > 0: Newton's method climbs to the root from the left
  for (int step = 0; step < 200; ++step) {
    const double change = (p - student_t_cdf(t, degrees)) / student_t_density(t, nu);
    t += change;
    if (std::abs(change) <= 1e-14 * t) break;
  }
  return t;
}

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
