#include "validation/expected.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/statistics.h"

namespace interflect::validation {

namespace {

using Statistic = scene::Expected::Statistic;

const char* describe(Statistic statistic) {
  switch (statistic) {
    case Statistic::mean:
      return "mean";
    case Statistic::min:
      return "min";
    case Statistic::max:
      return "max";
  }
  return "";
}

/// What a method found of a sensor, and the interval that its noise leaves for the truth.
struct Found {
  double value = std::numeric_limits<double>::quiet_NaN(), standard_error = 0;
  double low = value, high = value;
};

struct Point {
  double value, standard_error;
};

Found mean_of(const std::vector<Point>& points) {
  double sum = 0, squares = 0;
  for (const Point& p : points) {
    sum += p.value;
    squares += p.standard_error * p.standard_error;
  }
  const auto n = static_cast<double>(points.size());
  const double mean = sum / n, standard_error = std::sqrt(squares) / n;
  return {mean, standard_error, mean - 3 * standard_error, mean + 3 * standard_error};
}

/// @param sign  1 for the least, -1 for the largest
Found extreme_of(const std::vector<Point>& points, double sign) {
  const double beyond_3 = std::erfc(3 / std::sqrt(2.0));  // both tails
  const double z = sidak_z_max(beyond_3, points.size());
  const auto least = [&](double errors) {
    const auto key = [&](const Point& p) { return sign * p.value + errors * p.standard_error; };
    return *std::min_element(points.begin(), points.end(),
                             [&](const Point& p, const Point& q) { return key(p) < key(q); });
  };
  const Point at = least(0), low = least(-z), high = least(z);
  const double from = low.value - sign * z * low.standard_error, to = high.value + sign * z * high.standard_error;
  return {at.value, at.standard_error, std::min(from, to), std::max(from, to)};
}

/// @param points  of the sensor; their noise is independent
Found statistic_of(const std::vector<Point>& points, Statistic statistic) {
  if (points.empty()) return {};
  if (statistic == Statistic::mean) return mean_of(points);
  return extreme_of(points, statistic == Statistic::min ? 1 : -1);
}

}  // namespace

std::vector<ExpectedCheck> check_expected(const scene::Scene& scene, std::span<const Judged> judged) {
  const Reading reading{"weighted", scene.weights, true};
  std::vector<ExpectedCheck> checks;
  for (const scene::Expected& e : scene.expected) {
    std::vector<Point> fem, mc;
    for (const Judged& j : judged) {
      if (j.kind != Judged::Kind::sensor || j.group != e.sensor) continue;
      fem.push_back({reading.value(j.fem.value), reading.noise(j.fem).standard_error});
      mc.push_back({reading.value(j.mc.value), reading.noise(j.mc).standard_error});
    }
    const Found by_fem = statistic_of(fem, e.statistic), by_mc = statistic_of(mc, e.statistic);
    const double room = e.tolerance * std::abs(e.value);
    checks.push_back({e.sensor, describe(e.statistic), e.source, e.value, e.tolerance, by_fem.value, by_mc.value,
                      by_mc.standard_error, std::abs(by_fem.value - e.value) <= room,
                      by_mc.low - room <= e.value && e.value <= by_mc.high + room});
  }
  return checks;
}

}  // namespace interflect::validation
