#include "validation/expected.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

struct Found {
  double value = std::numeric_limits<double>::quiet_NaN(), standard_error = 0;
};

/// @param values, errors  of the sensor's points; independent
Found statistic_of(const std::vector<double>& values, const std::vector<double>& errors, Statistic statistic) {
  if (values.empty()) return {};
  if (statistic != Statistic::mean) {
    const auto at = statistic == Statistic::min ? std::min_element(values.begin(), values.end())
                                                : std::max_element(values.begin(), values.end());
    return {*at, errors[static_cast<std::size_t>(at - values.begin())]};
  }
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += values[i];
    squares += errors[i] * errors[i];
  }
  const auto n = static_cast<double>(values.size());
  return {sum / n, std::sqrt(squares) / n};
}

}  // namespace

std::vector<ExpectedCheck> check_expected(const scene::Scene& scene, std::span<const Judged> judged) {
  const Reading reading{"weighted", scene.weights};
  std::vector<ExpectedCheck> checks;
  for (const scene::Expected& e : scene.expected) {
    std::vector<double> fem, mc, se_fem, se_mc;
    for (const Judged& j : judged) {
      if (j.kind != Judged::Kind::sensor || j.group != e.sensor) continue;
      fem.push_back(reading.value(j.fem.value));
      mc.push_back(reading.value(j.mc.value));
      se_fem.push_back(reading.error(j.fem.standard_error));
      se_mc.push_back(reading.error(j.mc.standard_error));
    }
    const Found by_fem = statistic_of(fem, se_fem, e.statistic), by_mc = statistic_of(mc, se_mc, e.statistic);
    const double room = e.tolerance * std::abs(e.value);
    checks.push_back({e.sensor, describe(e.statistic), e.source, e.value, e.tolerance, by_fem.value, by_mc.value,
                      by_mc.standard_error, std::abs(by_fem.value - e.value) <= room,
                      std::abs(by_mc.value - e.value) <= room + 3 * by_mc.standard_error});
  }
  return checks;
}

}  // namespace interflect::validation
