#include "photometry/sensor_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace interflect::photometry {

namespace {

/// What a point may be at least and at most.
struct Range {
  double low, high;
};

/// Of all points of a sensor so far: the least and the largest of either end.
struct Ends {
  Range least, largest;
  void extend(const Range& point) {
    least = {std::min(least.low, point.low), std::min(least.high, point.high)};
    largest = {std::max(largest.low, point.low), std::max(largest.high, point.high)};
  }
};

double reach(double value, const Range& range) { return std::max(value - range.low, range.high - value); }

}  // namespace

double SensorSummary::uniformity_error() const {
  if (!(mean > error)) return std::numeric_limits<double>::infinity();
  const double low = std::max(0.0, minimum - minimum_error) / (mean + error),
               high = std::min(1.0, (minimum + minimum_error) / (mean - error));
  return reach(uniformity(), {low, high});
}

std::vector<SensorSummary> summarise(const scene::Scene& scene, std::span<const measure::SensorPoint> points,
                                     std::span<const Estimate> values) {
  if (points.size() != values.size()) throw core::PreconditionError("summarise: one estimate a point expected");
  std::vector<SensorSummary> summaries;
  std::vector<double> variances;  // of the sums
  std::vector<Ends> ends;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double value = scene.weigh(values[k].value), noise = scene.weigh(values[k].standard_error),
                 bound = scene.weigh(values[k].error_bound), off = bound + normal_95 * noise;
    const Range range{value - off, value + off};
    auto s = std::find_if(summaries.begin(), summaries.end(),
                          [&](const SensorSummary& o) { return o.sensor == points[k].sensor; });
    if (s == summaries.end()) {
      s = summaries.insert(summaries.end(), {points[k].sensor, 0, value, 0, value});
      variances.push_back(0);
      ends.push_back({range, range});
    }
    const auto i = static_cast<std::size_t>(s - summaries.begin());
    ++s->points;
    s->minimum = std::min(s->minimum, value);
    s->maximum = std::max(s->maximum, value);
    s->mean += value;  // sums until all points are in
    s->error += bound;
    variances[i] += noise * noise;
    ends[i].extend(range);
  }
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    SensorSummary& s = summaries[i];
    s.mean /= s.points;
    s.error = (s.error + normal_95 * std::sqrt(variances[i])) / s.points;
    s.minimum_error = reach(s.minimum, ends[i].least);
    s.maximum_error = reach(s.maximum, ends[i].largest);
  }
  return summaries;
}

}  // namespace interflect::photometry
