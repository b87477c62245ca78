#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/estimate.h"
#include "measure/sensor_points.h"
#include "scene/scene.h"

namespace interflect::photometry {

/// What a lighting engineer reads off a sensor: irradiance or illuminance over its points, weighted over the channels
/// [W/m² | lx].
struct SensorSummary {
  std::string sensor;
  int points = 0;
  double minimum = 0, mean = 0, maximum = 0;
  /// Of the mean: the mean error bound and normal_95 standard errors of the mean; points are taken as independent in
  /// noise.
  double error = 0;
  /// Of the least and the largest, by all points: each may be off by its error bound and normal_95 standard errors, and
  /// the least of the truth is between the least of what they may be at least and the least of what they may be at
  /// most.
  double minimum_error = 0, maximum_error = 0;
  double uniformity() const { return mean > 0 ? minimum / mean : 0; }  ///< U0 = E_min / E_avg
  /// By the errors of both at their worst; infinite where the mean may be 0.
  double uniformity_error() const;
};

/// One summary a sensor, in the order of their first points.  @param values  one estimate a point
std::vector<SensorSummary> summarise(const scene::Scene& scene, std::span<const measure::SensorPoint> points,
                                     std::span<const Estimate> values);

}  // namespace interflect::photometry
