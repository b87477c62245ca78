#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "measure/method.h"
#include "measure/surface_solution.h"
#include "montecarlo/exposure.h"

namespace interflect::montecarlo {

struct SampleReport;

/// What all integrators are told.
struct IntegratorSettings {
  std::uint64_t samples = 0;  ///< a measurement, or paths in all where they answer all; 0: as many as `target` asks for
  double target = 0.01;       ///< relative standard error
  std::string intersector = "embree";
  measure::PathClasses paths = measure::PathClasses::all();  ///< that count
  measure::SurfaceSolution solution;                         ///< of those that need one
  SampleReport* report = nullptr;  ///< of the samples behind the answers, to be added to; null: none
};

struct IntegratorEntry {
  std::string name, summary;
  bool shares_paths;  ///< a path serves all that is asked: `samples` are of all together
  std::unique_ptr<measure::Method> (*make)(const IntegratorSettings& settings);
  /// Pictures, that grow sample by sample and go on after a stop (render.h); null: it answers pixels alone.
  MakeExposure* expose = nullptr;
  bool by_quadrature = false;   ///< a picture's samples are points in `sequence_batches` copies, and may leave some out
  bool needs_solution = false;  ///< IntegratorSettings::solution
  bool inherits_error = false;  ///< of it: a bound that samples do not lower
  bool by_chance = false;       ///< meets lights by chance alone: where these are small, no sensible time is enough
};
const std::vector<IntegratorEntry>& known_integrators();
std::vector<std::string> integrator_names();
/// @throws core::InputError  with the names known
const IntegratorEntry& integrator_entry(const std::string& name);

/// @throws core::InputError  with the names known
std::unique_ptr<measure::Method> make_integrator(const std::string& name, const IntegratorSettings& settings);

}  // namespace interflect::montecarlo
