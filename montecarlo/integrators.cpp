#include "montecarlo/integrators.h"

#include "core/error.h"
#include "montecarlo/light_tracer.h"
#include "montecarlo/path_tracer.h"

namespace interflect::montecarlo {
namespace {

std::unique_ptr<measure::Method> path(const IntegratorSettings& settings) {
  PathTracerSettings of;
  of.samples = settings.samples;
  of.target = settings.target;
  of.intersector = settings.intersector;
  return std::make_unique<PathTracer>(of);
}

std::unique_ptr<measure::Method> light(const IntegratorSettings& settings) {
  LightTracerSettings of;
  of.paths = settings.samples;
  of.target = settings.target;
  of.intersector = settings.intersector;
  return std::make_unique<LightTracer>(of);
}

}  // namespace

const std::vector<IntegratorEntry>& known_integrators() {
  static const std::vector<IntegratorEntry> all{
      {"path", "paths from what is measured, lights found by both ways", path},
      {"light", "paths from lights, all measurements by the same ones", light},
  };
  return all;
}

std::vector<std::string> integrator_names() {
  std::vector<std::string> names;
  for (const IntegratorEntry& each : known_integrators()) names.push_back(each.name);
  return names;
}

std::unique_ptr<measure::Method> make_integrator(const std::string& name, const IntegratorSettings& settings) {
  std::string known;
  for (const IntegratorEntry& each : known_integrators()) {
    if (each.name == name) return each.make(settings);
    known += (known.empty() ? "" : ", ") + each.name;
  }
  throw core::InputError("integrator '" + name + "'", "one of " + known + " expected");
}

}  // namespace interflect::montecarlo
