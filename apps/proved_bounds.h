#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/solved_scene.h"
#include "fem/bounds/enclosure.h"

namespace interflect::apps {

/// Proved bounds of a solution and of what its sensors read (`--bounds`).
struct ProvedBounds {
  fem::Enclosure enclosure;
  std::vector<Interval> at_points;  ///< of the sensors' points
  double seconds;
};

/// What bounds take beside the solve, which differs between scenes by a factor of 20: very roughly.
double roughly_seconds_of_bounds(double elements, unsigned threads);
/// "; bounds very roughly 50 s more (...)", of so many elements, or of every hundred of them.
std::string bounds_forecast_text(std::optional<double> elements, unsigned threads);

/// Nothing where the run was stopped, which is said: the solution is worth keeping without.
/// @throws core::InputError  where there are none to be had
std::unique_ptr<ProvedBounds> proved_bounds(const SolvedScene& solved, double max_memory, Run& run);

/// How far the truth of a sensor's mean may be from a number, weighed over the channels.
double proved_error(const SolvedScene& solved, const ProvedBounds& bounds, const std::string& sensor, double mean);

/// The same of the mean irradiance of all elements, by area.
double proved_error(const SolvedScene& solved, const ProvedBounds& bounds, double mean);

/// "bounds      elements' mean irradiance is known within 3.12 % (mean of all, guaranteed); 12 s"
std::string bounds_text(const SolvedScene& solved, const ProvedBounds& bounds);
results::Record bounds_record(const SolvedScene& solved, const ProvedBounds& bounds);

}  // namespace interflect::apps
