#include "validation/norms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "core/vec.h"
#include "validation/comparison.h"
#include "validation/statistics.h"

namespace interflect::validation {

namespace {

struct Term {
  const Judged* judged;
  double a;     ///< area represented
  double d, H;  ///< FEM - MC, MC
  Noise mc;     ///< of the reference
  double bound;

  double variance() const { return mc.standard_error * mc.standard_error; }
  double known_variance() const { return mc.exact ? variance() : 0; }
  /// Unbiased for (FEM - H)², or too large.
  double square() const { return d * d - known_variance(); }
  /// Unbiased for the variance of d², or too large: 4 bias² s² + 2 s⁴ <= E[4 d² S²] for s <= S.
  double noise_of_square() const { return 4 * d * d * variance() - 2 * known_variance() * known_variance(); }
};

std::vector<Term> terms_of(std::span<const Judged> judged, const Reading& reading,
                           const std::function<bool(const Judged&)>& counts) {
  std::vector<Term> terms;
  for (const Judged& j : judged) {
    if (!counts(j)) continue;
    const Difference d = difference(j, reading);
    if (std::isfinite(d.fem) && std::isfinite(d.mc) && std::isfinite(d.standard_error))
      terms.push_back({&j, j.represented_area(), d.difference(), d.mc, reading.noise(j.mc), d.bound});
  }
  return terms;
}

template <class F>
double total(const std::vector<Term>& terms, F f) {
  double sum = 0;
  for (const Term& t : terms) sum += f(t);
  return sum;
}

/// Elements of one group of which only some were judged.
struct Stratum {
  double n = 0, area = 0, represented = 0;  ///< chosen, their own area, what they stand for
  double weighted = 0;                      ///< sum a y
  double squares = 0, noise = 0;            ///< sum a² (y - mean)², sum a² v
  bool complete() const { return area >= (1 - 1e-9) * represented; }
};

/// Variance of sum a y by the choice of elements, noise (variance v of y) taken out.
template <class Y, class V>
double choice_variance(const std::vector<Term>& terms, Y y, V v) {
  std::map<std::string, std::size_t> sizes;
  for (const Term& t : terms) ++sizes[t.judged->group];
  const auto key = [&](const Term& t) { return sizes[t.judged->group] > 1 ? t.judged->group : std::string("\nalone"); };
  std::map<std::string, Stratum> strata;
  for (const Term& t : terms) {
    Stratum& s = strata[key(t)];
    s.n += 1;
    s.area += t.judged->area;
    s.represented += t.a;
    s.weighted += t.a * y(t);
  }
  for (const Term& t : terms) {
    Stratum& s = strata[key(t)];
    const double off = y(t) - s.weighted / s.represented;
    s.squares += t.a * t.a * off * off;
    s.noise += t.a * t.a * v(t);
  }
  double variance = 0;
  for (const auto& [name, s] : strata)
    if (s.n > 1 && !s.complete())
      variance += (1 - s.area / s.represented) * std::max(0.0, s.n / (s.n - 1) * s.squares - s.noise);
  return variance;
}

double ratio(double part, double whole) {
  if (whole > 0) return part / whole;
  return part == 0 ? 0.0 : std::copysign(std::numeric_limits<double>::infinity(), part);
}

double root_ratio(double part, double whole) { return std::sqrt(ratio(std::max(0.0, part), whole)); }

Interval l2_norm(const std::vector<Term>& terms, double light) {
  const double sum = total(terms, [](const Term& t) { return t.a * t.square(); });
  const double lowest = total(terms, [](const Term& t) { return t.a * (t.d * t.d - t.variance()); });
  const double least = total(terms, [](const Term& t) { return 2 * t.a * t.a * t.variance() * t.variance(); });
  const double noise = std::max(least, total(terms, [](const Term& t) { return t.a * t.a * t.noise_of_square(); }));
  const double choice = choice_variance(
      terms, [](const Term& t) { return t.square(); },
      [](const Term& t) { return t.mc.exact ? t.noise_of_square() : 0; });
  const double reach = normal_95 * std::sqrt(noise + choice);
  return {root_ratio(sum, light), root_ratio(lowest - reach, light), root_ratio(sum + reach, light)};
}

Interval l1_norm(const std::vector<Term>& terms, double light) {
  const double sum = total(terms, [](const Term& t) { return t.a * std::abs(t.d); });
  const double square = total(terms, [](const Term& t) { return t.a * t.square(); });
  const double raw_square = total(terms, [](const Term& t) { return t.a * t.d * t.d; });
  const double folded = std::sqrt(2 / pi) * total(terms, [](const Term& t) { return t.a * t.mc.standard_error; });
  const double noise = total(terms, [](const Term& t) { return t.a * t.a * t.variance(); });
  const double choice = choice_variance(
      terms, [](const Term& t) { return std::abs(t.d); },
      [](const Term& t) { return (1 - 2 / pi) * t.known_variance(); });
  const double reach = normal_95 * std::sqrt(noise + choice);
  const double low = std::max(0.0, sum - folded - reach), high = sum + reach;
  const double value = std::clamp(sum * root_ratio(square, raw_square), low, high);
  return {ratio(value, light), ratio(low, light), ratio(high, light)};
}

Interval bias_of(const std::vector<Term>& terms, double light) {
  const double sum = total(terms, [](const Term& t) { return t.a * t.d; });
  const double noise = total(terms, [](const Term& t) { return t.a * t.a * t.variance(); });
  const double choice = choice_variance(
      terms, [](const Term& t) { return t.d; }, [](const Term& t) { return t.known_variance(); });
  const double reach = normal_95 * std::sqrt(noise + choice);
  return {ratio(sum, light), ratio(sum - reach, light), ratio(sum + reach, light)};
}

Interval maximum_norm(const std::vector<Term>& terms, double mean, std::string& worst) {
  const double z = sidak_z_max(0.05, terms.size());
  Interval largest;
  for (const Term& t : terms) {
    if (worst.empty() || std::abs(t.d) > largest.value) worst = t.judged->name;
    largest.value = std::max(largest.value, std::abs(t.d));
    largest.low = std::max(largest.low, std::abs(t.d) - z * t.mc.standard_error);
    largest.high = std::max(largest.high, std::abs(t.d) + z * t.mc.standard_error);
  }
  return {ratio(largest.value, mean), ratio(largest.low, mean), ratio(largest.high, mean)};
}

}  // namespace

Norms error_norms(std::span<const Judged> judged, const Reading& reading,
                  const std::function<bool(const Judged&)>& counts) {
  const std::vector<Term> terms = terms_of(judged, reading, counts);
  Norms norms;
  norms.measurements = terms.size();
  if (terms.empty()) return norms;
  const double light = total(terms, [](const Term& t) { return t.a * std::abs(t.H); });
  // In a denominator an upper bound of the noise is on the safe side.
  const double square = std::max(0.0, total(terms, [](const Term& t) { return t.a * (t.H * t.H - t.variance()); }));
  norms.area = total(terms, [](const Term& t) { return t.a; });
  norms.mean_irradiance = ratio(total(terms, [](const Term& t) { return t.a * t.H; }), norms.area);
  norms.l1 = l1_norm(terms, light);
  norms.l2 = l2_norm(terms, square);
  norms.bias = bias_of(terms, light);
  norms.max = maximum_norm(terms, ratio(light, norms.area), norms.worst);
  const double noise = total(terms, [](const Term& t) { return t.a * t.variance(); });
  const double spread = total(terms, [](const Term& t) { return 2 * t.a * t.a * t.variance() * t.variance(); });
  norms.reference_error = root_ratio(sum_of_squares_quantile(noise, spread, 0.95), square);
  norms.claimed_error = root_ratio(total(terms, [](const Term& t) { return t.a * t.bound * t.bound; }), square);
  return norms;
}

}  // namespace interflect::validation
