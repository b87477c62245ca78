#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/commands.h"
#include "apps/options.h"
#include "fem/radiosity_method.h"
#include "fem/residual.h"
#include "measure/sensor_points.h"
#include "raycast/ray_caster.h"
#include "results/output_directory.h"
#include "results/record.h"
#include "scene/scene.h"

namespace interflect::apps {

struct ProvedBounds;

/// A scene with its radiosity solution and the answers at its sensors: what `solve` writes and `validate` judges.
///
/// It stays where it was made: the ray caster refers to the scene.
struct SolvedScene {
  SolvedScene(scene::Scene scene_read, const fem::Forecast& forecast_made, fem::RadiositySolution solution_found)
      : scene(std::move(scene_read)), forecast(forecast_made), solution(std::move(solution_found)) {}
  SolvedScene(const SolvedScene&) = delete;
  SolvedScene& operator=(const SolvedScene&) = delete;

  scene::Scene scene;
  fem::Forecast forecast;
  fem::RadiositySolution solution;
  std::unique_ptr<raycast::RayCaster> rays;
  std::vector<measure::SensorPoint> points;
  std::vector<Estimate> at_points;
  std::vector<std::string> warnings;                 ///< of the reader, then of the solution
  std::unique_ptr<results::OutputDirectory> folder;  ///< options.out
  std::shared_ptr<const ProvedBounds> bounds;        ///< none where they were not asked for
  std::optional<fem::ResidualNorms> residual;        ///< likewise

  fem::RadiosityMethod method() const { return {solution, *rays}; }
};

/// What a solution's energy balance shows to be odd, in sentences: flux on black backs, beyond the noise of the rays
/// that found it, and form factors and rays that disagree.
std::vector<std::string> energy_warnings(const scene::Scene& scene, const fem::RadiositySolution& solution);
/// What a solution fell short of: the tolerance of its rows, that of the solver, that of its goal.
std::vector<std::string> shortfalls_of(const fem::RadiositySolution& solution, const fem::RadiositySettings& settings);

/// What is known at points of sensors.
std::vector<Estimate> answers_at(std::span<const measure::SensorPoint> points, const fem::RadiosityMethod& method,
                                 const scene::Scene& scene, Run& run);

/// "5 000 elements, 0.2 GB, about 40 s"
std::string describe(const fem::Forecast& forecast);
results::Record forecast_record(const fem::Forecast& forecast);

/// Read to be solved; for bounds nothing may be there twice.
scene::Scene scene_to_solve(const SolveOptions& options);

/// With --forecast, what the solve will need is the result.
ExitStatus print_forecast(const SolveOptions& options, const CommonOptions& common, const Run& run);

/// Forecasts, prepares the output folder, solves, answers the sensors, and warns of what the solution shows.
/// @throws core::InputError, core::Interrupted
std::unique_ptr<SolvedScene> solve_scene(scene::Scene scene, const SolveOptions& options, const CommonOptions& common,
                                         Run& run);

}  // namespace interflect::apps
