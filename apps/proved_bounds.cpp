#include "apps/proved_bounds.h"

#include <algorithm>
#include <chrono>

#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "core/seconds_since.h"

namespace interflect::apps {
namespace {

std::vector<Interval> bounds_at_points(const SolvedScene& solved, const fem::Enclosure& enclosure, Run& run) {
  std::vector<Interval> bounds(solved.points.size());
  core::Progress::Stage stage(run.progress, "bounds at sensors", bounds.size());
  run.threads.for_blocks(static_cast<Index>(bounds.size()), 1, [&](Index k, Index) {
    run.throw_if_stopped("bounds");
    const auto point = static_cast<std::size_t>(k);
    bounds[point] = enclosure.irradiance_at(solved.points[point].at);
    stage.advance(1);
  });
  return bounds;
}

/// Means by area over the elements, weighed over the channels.
struct Widths {
  double irradiance = 0, half_width = 0;
};
Widths widths_of(const SolvedScene& solved, const fem::Enclosure& enclosure) {
  Widths mean;
  double area = 0;
  for (std::size_t i = 0; i < solved.solution.irradiance.size(); ++i) {
    const double of_element = solved.solution.mesh.patches()[i].area;
    const Interval& H = enclosure.mean_irradiance()[i];
    mean.irradiance += of_element * solved.scene.weigh(solved.solution.irradiance[i]);
    mean.half_width += of_element * 0.5 * solved.scene.weigh(H.upper - H.lower);
    area += of_element;
  }
  return {mean.irradiance / area, mean.half_width / area};
}

/// Measured, of one core an element: 0.02 in an empty room, 0.1 where much is hidden in part, 0.4 in an open scene.
constexpr double seconds_an_element = 0.1;

}  // namespace

double roughly_seconds_of_bounds(double elements, unsigned threads) { return seconds_an_element * elements / threads; }

std::string bounds_forecast_text(std::optional<double> elements, unsigned threads) {
  const double seconds = roughly_seconds_of_bounds(elements.value_or(100), threads);
  return core::format("; bounds very roughly %s more%s (a fifth in an empty room, four times as much in an open scene)",
                      core::format_duration(seconds).c_str(),
                      elements ? "" : " for every hundred elements of the last pass");
}

std::unique_ptr<ProvedBounds> proved_bounds(const SolvedScene& solved, double max_memory, Run& run) {
  const auto start = std::chrono::steady_clock::now();
  try {
    auto bounds = std::make_unique<ProvedBounds>(
        ProvedBounds{fem::Enclosure(solved.scene, solved.solution, max_memory, run), {}, 0});
    bounds->at_points = bounds_at_points(solved, bounds->enclosure, run);
    bounds->seconds = core::seconds_since(start);
    return bounds;
  } catch (const core::Interrupted&) {
    core::log::shortfall("stopped before its bounds were found: the solution is written without");
    return nullptr;
  }
}

double proved_error(const SolvedScene& solved, const ProvedBounds& bounds, const std::string& sensor, double mean) {
  double lower = 0, upper = 0, points = 0;
  for (std::size_t k = 0; k < solved.points.size(); ++k) {
    if (solved.points[k].sensor != sensor) continue;
    lower += solved.scene.weigh(bounds.at_points[k].lower);
    upper += solved.scene.weigh(bounds.at_points[k].upper);
    ++points;
  }
  return std::max({upper / points - mean, mean - lower / points, 0.0});
}

double proved_error(const SolvedScene& solved, const ProvedBounds& bounds, double mean) {
  double lower = 0, upper = 0, area = 0;
  for (std::size_t i = 0; i < solved.solution.irradiance.size(); ++i) {
    const double of_element = solved.solution.mesh.patches()[i].area;
    const Interval& H = bounds.enclosure.mean_irradiance()[i];
    lower += of_element * solved.scene.weigh(H.lower);
    upper += of_element * solved.scene.weigh(H.upper);
    area += of_element;
  }
  return std::max({upper / area - mean, mean - lower / area, 0.0});
}

std::string bounds_text(const SolvedScene& solved, const ProvedBounds& bounds) {
  const Widths mean = widths_of(solved, bounds.enclosure);
  return core::format("bounds      elements' mean irradiance is known within %s (mean of all, guaranteed); %s\n",
                      core::format_percent(core::rounded_up(mean.half_width / mean.irradiance, 3)).c_str(),
                      core::format_duration(bounds.seconds).c_str());
}

results::Record bounds_record(const SolvedScene& solved, const ProvedBounds& bounds) {
  const Widths mean = widths_of(solved, bounds.enclosure);
  results::Record record;
  return record.add("claim", "guaranteed")
      .add("mean_irradiance", mean.irradiance)
      .add("mean_half_width", mean.half_width)
      .add("seconds", bounds.seconds);
}

}  // namespace interflect::apps
