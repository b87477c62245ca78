#include "montecarlo/integrators.h"

#include "core/error.h"
#include "montecarlo/bidirectional/bidirectional_exposure.h"
#include "montecarlo/bidirectional/bidirectional_tracer.h"
#include "montecarlo/controlled/controlled.h"
#include "montecarlo/light_exposure.h"
#include "montecarlo/light_tracer.h"
#include "montecarlo/path_exposure.h"
#include "montecarlo/path_tracer.h"
#include "montecarlo/ray_tree/distributed.h"
#include "montecarlo/ray_tree/whitted.h"
#include "montecarlo/two_pass/two_pass.h"

namespace interflect::montecarlo {
namespace {

template <class Settings>
Settings told(const IntegratorSettings& asked) {
  Settings settings;
  settings.samples = asked.samples;
  settings.target = asked.target;
  settings.intersector = asked.intersector;
  settings.paths = asked.paths;
  settings.report = asked.report;
  if constexpr (requires { settings.solution; }) settings.solution = asked.solution;
  return settings;
}

template <class Integrator, class Settings>
std::unique_ptr<measure::Method> make(const IntegratorSettings& asked) {
  return std::make_unique<Integrator>(told<Settings>(asked));
}

std::unique_ptr<measure::Method> make_unidirectional(const IntegratorSettings& asked) {
  auto settings = told<PathTracerSettings>(asked);
  settings.next_event = NextEvent::no;
  return std::make_unique<PathTracer>(std::move(settings));
}

}  // namespace

const std::vector<IntegratorEntry>& known_integrators() {
  static const std::vector<IntegratorEntry> all{
      {"path", "paths from what is measured, lights found by both ways", false, make<PathTracer, PathTracerSettings>,
       path_exposure},
      {.name = "unidirectional",
       .summary = "the same, lights found by chance alone: noisy, and simple enough to judge the others by",
       .shares_paths = false,
       .make = make_unidirectional,
       .expose = unidirectional_exposure,
       .by_chance = true},
      {"bidirectional", "walks from both ends, joined in all ways", false,
       make<BidirectionalTracer, BidirectionalTracerSettings>, bidirectional_exposure},
      {"light", "paths from lights, all measurements by the same ones", true, make<LightTracer, LightTracerSettings>,
       light_exposure},
      {"distributed", "Cook's ray tracing: light that meets one diffuse surface at most", false,
       make<Distributed, DistributedSettings>, distributed_exposure},
      {"whitted", "the same without chance, and without glossy reflections", false, make<Whitted, WhittedSettings>,
       whitted_exposure, true},
      {.name = "two-pass",
       .summary = "radiosity for what is diffuse, paths for the rest",
       .shares_paths = false,
       .make = make<TwoPass, TwoPassSettings>,
       .expose = two_pass_exposure,
       .needs_solution = true,
       .inherits_error = true},
      {.name = "controlled",
       .summary = "paths that end where radiosity says what is left, without its error",
       .shares_paths = false,
       .make = make<Controlled, ControlledSettings>,
       .expose = controlled_exposure,
       .needs_solution = true},
  };
  return all;
}

std::vector<std::string> integrator_names() {
  std::vector<std::string> names;
  for (const IntegratorEntry& each : known_integrators()) names.push_back(each.name);
  return names;
}

const IntegratorEntry& integrator_entry(const std::string& name) {
  std::string known;
  for (const IntegratorEntry& each : known_integrators()) {
    if (each.name == name) return each;
    known += (known.empty() ? "" : ", ") + each.name;
  }
  throw core::InputError("integrator '" + name + "'", "one of " + known + " expected");
}

std::unique_ptr<measure::Method> make_integrator(const std::string& name, const IntegratorSettings& settings) {
  return integrator_entry(name).make(settings);
}

}  // namespace interflect::montecarlo
