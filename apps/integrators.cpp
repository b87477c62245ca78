#include "montecarlo/integrators.h"

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "apps/commands.h"
#include "core/format.h"
#include "measure/path_classes.h"
#include "montecarlo/scene_paths.h"
#include "results/record.h"

namespace interflect::apps {
namespace {

using measure::PathClasses;
using montecarlo::IntegratorEntry;

/// What may be asked for, of one kind.
struct Kind {
  const char* name;
  measure::Measurement asked;
};
std::vector<Kind> kinds() {
  std::vector<Kind> all;
  all.push_back({"patches", measure::Flux{}});
  all.push_back({"points", measure::PointIrradiance{Vec3::Zero(), Vec3::UnitZ(), {}}});
  all.push_back({"pixels", measure::PixelRadiance{}});
  return all;
}

/// The paths that it finds to what is asked, and one of the shortest that it misses; none: it finds all.
struct Finds {
  std::string paths, misses;
  bool operator==(const Finds&) const = default;
};
Finds found(const measure::Capabilities& capabilities, const measure::Measurement& asked) {
  const PathClasses& finds = capabilities.paths_to(asked);
  return {finds.expression(), (montecarlo::that_reach(asked, PathClasses::all()) - finds).shortest()};
}

std::string line(const std::string& of, const std::string& text) {
  return core::format("  %-18s  %s\n", of.c_str(), text.c_str());
}

const char* promise(const IntegratorEntry& entry, const measure::Capabilities& capabilities) {
  if (capabilities.unbiased) return "unbiased: right in the mean, whatever the number of samples";
  if (capabilities.consistent) return "consistent: right in the limit of many samples";
  return entry.inherits_error
             ? "neither unbiased nor consistent: the error of the solution stays, as an error bound"
             : "neither unbiased nor consistent: what its quadrature leaves out stays, as an error bound";
}

/// A line for all that it finds the same paths to.
std::string finds_text(const measure::Capabilities& capabilities) {
  std::vector<std::pair<std::string, Finds>> lines;
  for (const Kind& kind : kinds()) {
    const Finds finds = found(capabilities, kind.asked);
    if (!lines.empty() && lines.back().second == finds)
      lines.back().first += std::string(", ") + kind.name;
    else
      lines.emplace_back(std::string("to ") + kind.name, finds);
  }
  std::string text;
  for (const auto& [to, finds] : lines)
    text += line(to, finds.paths + (finds.misses.empty() ? "" : ", not " + finds.misses));
  return text;
}

std::string text_of(const IntegratorEntry& entry, const measure::Capabilities& capabilities) {
  std::string text = entry.name + "\n  " + entry.summary + "\n";
  text += line("promises", promise(entry, capabilities)) + finds_text(capabilities);
  if (entry.by_chance) text += line("slow with", "small lights: it meets them by chance alone");
  if (entry.needs_solution) text += line("needs", "a radiosity solution, which is found first");
  return text;
}

results::Record record_of(const IntegratorEntry& entry, const measure::Capabilities& capabilities) {
  results::Record finds, misses, record;
  for (const Kind& kind : kinds()) {
    const auto [paths, missed] = found(capabilities, kind.asked);
    finds.add(kind.name, paths);
    misses.add(kind.name, missed);
  }
  return record.add("name", entry.name)
      .add("summary", entry.summary)
      .add("unbiased", capabilities.unbiased)
      .add("consistent", capabilities.consistent)
      .add("finds", std::move(finds))
      .add("misses", std::move(misses))
      .add("by_chance", entry.by_chance)
      .add("needs_solution", entry.needs_solution);
}

constexpr const char* legend = R"(
to patches, points, pixels: the paths of light that it finds to the mean irradiance of a patch (and to fluxes), to the
irradiance at a point, to a pixel.  They go from the light to the eye [Heckbert 1990]: L any light (A with an area, P a
point or spot, F the sun or sky, B parallel light), D diffuse, G glossy, S mirror or smooth glass, . any of these, E what
is measured; ( ) | * + ? as ever.
not PSE: such paths are missed, this being one of the shortest.  Scenes that have some are refused; --paths asks for
others alone.
)";

}  // namespace

ExitStatus integrators(const ListOptions&, const CommonOptions& common, Run&) {
  results::Record::List list;
  for (const IntegratorEntry& entry : montecarlo::known_integrators()) {
    const measure::Capabilities capabilities = montecarlo::make_integrator(entry.name, {})->capabilities();
    if (common.json)
      list.push_back(record_of(entry, capabilities));
    else
      std::fputs((text_of(entry, capabilities) + "\n").c_str(), stdout);
  }
  if (common.json)
    std::printf("%s\n", results::json_text(results::Record().add("integrators", std::move(list))).c_str());
  else
    std::fputs(legend + 1, stdout);
  return success;
}

}  // namespace interflect::apps
