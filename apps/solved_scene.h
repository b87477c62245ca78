#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/options.h"
#include "fem/radiosity_method.h"
#include "measure/sensor_points.h"
#include "raycast/ray_caster.h"
#include "scene/scene.h"

namespace interflect::apps {

/// A scene with its radiosity solution and the answers at its sensors: what `solve` writes and `validate` judges.
///
/// It stays where it was made: the ray caster refers to the scene.
struct SolvedScene {
  SolvedScene(scene::Scene scene_read, const fem::Forecast& forecast_made, fem::RadiositySolution solution_found,
              std::vector<measure::SensorPoint> points_asked)
      : scene(std::move(scene_read)), forecast(forecast_made), solution(std::move(solution_found)), points(std::move(points_asked)) {}
  SolvedScene(const SolvedScene&) = delete;
  SolvedScene& operator=(const SolvedScene&) = delete;

  scene::Scene scene;
  fem::Forecast forecast;
  fem::RadiositySolution solution;
  std::unique_ptr<raycast::RayCaster> rays;
  std::vector<measure::SensorPoint> points;
  std::vector<Estimate> at_points;

  fem::RadiosityMethod method() const { return {solution, *rays}; }
};

/// Reads the scene and prints what was noted about it; nothing is written yet.
scene::Scene read_and_note(const std::filesystem::path& file);

/// "5 000 elements, 0.2 GB, about 40 s"
std::string describe(const fem::Forecast& forecast);

/// Reads, forecasts, prepares the output folder, solves, answers the sensors.  Null where only the forecast was asked for.
/// @throws core::InputError, core::Interrupted
std::unique_ptr<SolvedScene> solve_scene(const SolveOptions& options, const CommonOptions& common, Run& run);

}  // namespace interflect::apps
