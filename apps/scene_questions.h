#pragma once

#include <span>
#include <utility>
#include <vector>

#include "measure/method.h"
#include "measure/sensor_points.h"

namespace interflect::apps {

/// What is asked of a scene that has no elements: the flux on every active side of every surface, and all points of its
/// sensors.
struct SceneQuestions {
  std::vector<std::pair<scene::SurfaceId, scene::Side>> sides;
  std::vector<measure::SensorPoint> points;
  std::vector<measure::Measurement> on_sides, at_points;  ///< in their order
};
SceneQuestions questions_about(const scene::Scene& scene);

/// Fluxes as mean irradiances, in the order of the sides.
std::vector<Estimate> mean_irradiances(const scene::Scene& scene, const SceneQuestions& questions,
                                       std::span<const Estimate> fluxes);

/// "desk", "desk/back".
std::string name_of(const scene::Scene& scene, const std::pair<scene::SurfaceId, scene::Side>& side);

}  // namespace interflect::apps
