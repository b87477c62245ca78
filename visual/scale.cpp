#include "visual/scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/format.h"
#include "results/tone_mapping.h"

namespace interflect::visual {

namespace {

constexpr double most_decades = 1e4;

/// 1, 2 and 5 times powers of ten: the k-th, 10^(k / 3) where k is a multiple of 3.
double one_two_five(int k) {
  const int decade = static_cast<int>(std::floor(k / 3.0));
  constexpr double steps[] = {1, 2, 5};
  return steps[k - 3 * decade] * std::pow(10.0, decade);
}

/// The last of them that is not above x.
int one_two_five_below(double x) {
  int k = 3 * static_cast<int>(std::floor(std::log10(x))) - 1;
  while (one_two_five(k + 1) <= x * (1 + 1e-12)) ++k;
  return k;
}

std::vector<double> logarithmic_ticks(const Range& range) {
  constexpr std::size_t most = 15;
  std::vector<double> all, tens;
  for (int k = one_two_five_below(range.low * (1 - 1e-9)) + 1; one_two_five(k) <= range.high * (1 + 1e-9); ++k) {
    all.push_back(one_two_five(k));
    if (k % 3 == 0) tens.push_back(one_two_five(k));
  }
  return all.size() <= most ? all : tens;
}

}  // namespace

double Range::part(double value) const {
  if (!logarithmic) return (value - low) / (high - low);
  return std::isnan(value) ? value : std::log(std::max(value, low) / low) / std::log(high / low);
}

double round_up(double x) {
  if (!(x > 0) || !std::isfinite(x)) return 1;
  const double ten = std::pow(10.0, std::floor(std::log10(x)));
  for (double step : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (x <= step * ten * (1 + 1e-12)) return step * ten;
  return 10 * ten;
}

Range range_of(std::span<const double> values, std::span<const double> areas, bool diverging) {
  std::vector<double> sizes(values.begin(), values.end());
  if (diverging)
    for (double& v : sizes) v = std::abs(v);
  const double high = round_up(results::weighted_quantile(sizes, areas, 0.99));
  return {diverging ? -high : 0.0, high};
}

Range rounded_outwards(double low, double high) {
  const int first = one_two_five_below(low), last = one_two_five_below(high * (1 - 1e-9)) + 1;
  return {one_two_five(first), one_two_five(std::max(last, first + 1)), true};
}

Range logarithmic_range(std::span<const double> values, std::span<const double> weights) {
  std::vector<double> positive(values.begin(), values.end());
  for (double& v : positive)
    if (!(v > 0)) v = std::numeric_limits<double>::quiet_NaN();  // left out
  const double most = results::weighted_quantile(positive, weights, 0.99);
  if (!(most > 0)) return {0.1, 1, true};
  const double least = std::max(results::weighted_quantile(positive, weights, 0.01), most / most_decades);
  return rounded_outwards(least, most);
}

std::vector<double> ticks_of(const Range& range) {
  if (range.logarithmic) return logarithmic_ticks(range);
  const double span = range.high - range.low, ten = std::pow(10.0, std::floor(std::log10(span / 4)));
  const auto whole = [](double x) { return std::abs(x - std::round(x)) < 1e-6; };
  double step = 0, even_step = 0;  // the largest that gives four intervals; the same among those that end on both ends
  for (double factor : {0.5, 1.0, 2.0, 2.5, 5.0, 10.0}) {
    const double candidate = factor * ten;
    if (span / candidate < 4 - 1e-9) break;
    step = candidate;
    if (whole(range.low / candidate) && whole(range.high / candidate) && span / candidate <= 12 + 1e-9)
      even_step = candidate;
  }
  if (even_step > 0) step = even_step;
  std::vector<double> ticks;
  for (double k = std::ceil(range.low / step - 1e-9); k * step <= range.high + 1e-9 * span; k += 1)
    ticks.push_back(k == 0 ? 0.0 : k * step);
  return ticks;
}

std::string tick_label(double value, double step) {
  if (value == 0) return "0";
  const double largest = std::abs(value);
  if (largest >= 1e6 || step < 1e-4) return core::format("%.3g", value);
  if (step >= 1 && std::abs(value - std::round(value)) < 1e-6 * step) {
    const std::string digits = largest < 9999.5
                                   ? core::format("%.0f", largest)
                                   : core::format_count(static_cast<unsigned long long>(std::lround(largest)));
    return (value < 0 ? "-" : "") + digits;
  }
  const int decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(step))));
  std::string text = core::format("%.*f", decimals, value);
  while (text.find('.') != std::string::npos && (text.back() == '0' || text.back() == '.')) {
    const bool point = text.back() == '.';
    text.pop_back();
    if (point) break;
  }
  return text;
}

}  // namespace interflect::visual
