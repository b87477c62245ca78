#include "photometry/sensor_summary.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace interflect::photometry {

std::vector<SensorSummary> summarise(const scene::Scene& scene, std::span<const measure::SensorPoint> points,
                                     std::span<const Estimate> values) {
  if (points.size() != values.size()) throw core::PreconditionError("summarise: one estimate a point expected");
  std::vector<SensorSummary> summaries;
  std::vector<double> variances;  // of the sums
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double value = scene.weigh(values[k].value), noise = scene.weigh(values[k].standard_error);
    auto s = std::find_if(summaries.begin(), summaries.end(),
                          [&](const SensorSummary& o) { return o.sensor == points[k].sensor; });
    if (s == summaries.end()) {
      s = summaries.insert(summaries.end(), {points[k].sensor, 0, value, 0, value, 0});
      variances.push_back(0);
    }
    ++s->points;
    s->minimum = std::min(s->minimum, value);
    s->maximum = std::max(s->maximum, value);
    s->mean += value;  // sums until all points are in
    s->error += scene.weigh(values[k].error_bound);
    variances[static_cast<std::size_t>(s - summaries.begin())] += noise * noise;
  }
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    SensorSummary& s = summaries[i];
    s.mean /= s.points;
    s.error = (s.error + normal_95 * std::sqrt(variances[i])) / s.points;
  }
  return summaries;
}

}  // namespace interflect::photometry
