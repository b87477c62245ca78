#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "measure/method.h"

namespace interflect::montecarlo {

/// What all integrators are told.
struct IntegratorSettings {
  std::uint64_t samples = 0;  ///< a measurement, or paths in all where they answer all; 0: as many as `target` asks for
  double target = 0.01;       ///< relative standard error
  std::string intersector = "embree";
  measure::PathClasses paths = measure::PathClasses::all();  ///< that count
};

struct IntegratorEntry {
  std::string name, summary;
  bool shares_paths;  ///< a path serves all that is asked: `samples` are of all together
  std::unique_ptr<measure::Method> (*make)(const IntegratorSettings& settings);
};
const std::vector<IntegratorEntry>& known_integrators();
std::vector<std::string> integrator_names();
/// @throws core::InputError  with the names known
const IntegratorEntry& integrator_entry(const std::string& name);

/// @throws core::InputError  with the names known
std::unique_ptr<measure::Method> make_integrator(const std::string& name, const IntegratorSettings& settings);

}  // namespace interflect::montecarlo
