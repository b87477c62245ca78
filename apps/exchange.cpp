#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "apps/commands.h"
#include "apps/contacts.h"
#include "apps/read_scene.h"
#include "apps/solution_files.h"
#include "apps/solved_scene.h"
#include "apps/table.h"
#include "apps/with_error.h"
#include "core/format.h"
#include "core/log.h"
#include "fem/thermal_exchange.h"
#include "results/atomic_file.h"
#include "results/csv.h"
#include "results/output_directory.h"
#include "results/record.h"
#include "results/vtu.h"

#ifdef INTERFLECT_WITH_VTK
#include "apps/display_or_warning.h"
#include "apps/element_picture.h"
#endif

namespace interflect::apps {
namespace {

using fem::ThermalExchange;
using fem::ThermalState;
using fem::ThermalSurface;

std::string csv_of(const ThermalExchange& exchange) {
  results::Csv csv;
  for (const char* heading :
       {"name", "area", "emissivity", "temperature", "temperature_error", "heat_flux", "heat_flux_error", "flux",
        "flux_error", "radiosity", "radiosity_error", "irradiance", "irradiance_error"})
    csv.text(heading);
  csv.end_line();
  for (const ThermalSurface& s : exchange.surfaces) {
    csv.text(s.name).number(s.area).number(s.emissivity);
    csv.number(s.temperature).number(s.temperature_error).number(s.heat_flux).number(s.heat_flux_error);
    csv.number(s.flux()).number(s.flux_error());
    csv.number(s.radiosity).number(s.radiosity_error).number(s.irradiance).number(s.irradiance_error).end_line();
  }
  return csv.str();
}

std::string table_of(const ThermalExchange& exchange) {
  Table table({"surface", "area m2", "emissivity", "T K", "q W/m2", "Q W"});
  const auto given = [](double value) { return core::format("%.6g", value); };
  for (const ThermalSurface& s : exchange.surfaces)
    table.add({s.name, core::format("%.4g", s.area), core::format("%.4g", s.emissivity),
               s.flux_given ? with_error(s.temperature, s.temperature_error) : given(s.temperature),
               s.flux_given ? given(s.heat_flux) : with_error(s.heat_flux, s.heat_flux_error),
               s.flux_given ? given(s.flux()) : with_error(s.flux(), s.flux_error())});
  return table.text();
}

results::Record record_of(const ThermalExchange& exchange, const ExchangeOptions& options) {
  results::Record::List surfaces;
  for (const ThermalSurface& s : exchange.surfaces)
    surfaces.push_back(results::Record()
                           .add("name", s.name)
                           .add("area", s.area)
                           .add("emissivity", s.emissivity)
                           .add("temperature", s.temperature)
                           .add("temperature_error", s.temperature_error)
                           .add("heat_flux", s.heat_flux)
                           .add("heat_flux_error", s.heat_flux_error)
                           .add("heat_flux_given", s.flux_given)
                           .add("flux", s.flux())
                           .add("flux_error", s.flux_error())
                           .add("elements", static_cast<std::int64_t>(s.elements))
                           .add("elements_without_temperature", static_cast<std::int64_t>(s.without_temperature))
                           .add("radiosity", s.radiosity)
                           .add("radiosity_error", s.radiosity_error)
                           .add("irradiance", s.irradiance)
                           .add("irradiance_error", s.irradiance_error));
  results::Record record;
  record.add("scene", options.scene.string())
      .add("environment_K", options.environment)
      .add("elements", static_cast<std::int64_t>(exchange.solution.mesh.size()))
      .add("net_flux_W", exchange.emitted)
      .add("net_flux_error_W", exchange.emitted_error)
      .add("to_environment_W", exchange.to_environment)
      .add("to_environment_error_W", exchange.to_environment_error)
      .add("settings", settings_record(options.settings, exchange.solution))
      .add("form_factors", form_factor_record(exchange.solution))
      .add("surfaces", std::move(surfaces));
  return record;
}

std::vector<double> of_elements(const ThermalExchange& exchange, double ThermalState::*what) {
  std::vector<double> values;
  for (const ThermalState& state : exchange.elements) values.push_back(state.*what);
  return values;
}

void write_fields(const std::filesystem::path& file, const ThermalExchange& exchange) {
  const mesh::ElementMesh& mesh = exchange.solution.mesh;
  std::vector<results::CellField> fields = results::id_fields(mesh);
  const auto add = [&](const std::string& name, double ThermalState::*value, double ThermalState::*error) {
    fields.push_back(results::scalar_field(name, of_elements(exchange, value)));
    fields.push_back(results::scalar_field(name + "_error", of_elements(exchange, error)));
  };
  add("temperature", &ThermalState::temperature, &ThermalState::temperature_error);
  add("heat_flux", &ThermalState::heat_flux, &ThermalState::heat_flux_error);
  add("radiosity", &ThermalState::radiosity, &ThermalState::radiosity_error);
  add("irradiance", &ThermalState::irradiance, &ThermalState::irradiance_error);
  results::write_vtu(file, mesh, fields);
}

#ifdef INTERFLECT_WITH_VTK
/// Temperatures are far from 0 and near each other.
visual::Range span_of(std::span<const double> values) {
  visual::Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double value : values)
    if (!std::isnan(value)) range = {std::min(range.low, value), std::max(range.high, value)};
  return range.low < range.high ? range : visual::Range{range.low - 1, range.high + 1};
}

void write_pictures(const std::filesystem::path& folder, const scene::Scene& scene, const ThermalExchange& exchange) {
  const auto display = display_or_warning();
  if (!display) return;
  const mesh::ElementMesh& mesh = exchange.solution.mesh;
  const std::vector<double> temperature = of_elements(exchange, &ThermalState::temperature);
  write_element_picture(*display, folder / "temperature.png", scene, mesh, temperature,
                        {.title = "temperature [K]", .caption = {}, .range = span_of(temperature)});
  write_element_picture(*display, folder / "heat_flux.png", scene, mesh,
                        of_elements(exchange, &ThermalState::heat_flux),
                        {.title = "net heat flux [W/m2]", .caption = {}, .map = results::ColourMap::blue_white_red});
}
#endif

/// Warns of what it fell short of.
void warn_of(const ThermalExchange& exchange, const fem::RadiositySettings& settings) {
  for (const std::string& warning : energy_warnings(exchange.problem, exchange.solution)) core::log::warning(warning);
  for (const std::string& shortfall : shortfalls_of(exchange.solution, settings)) core::log::shortfall(shortfall);
  for (const ThermalSurface& s : exchange.surfaces)
    if (s.without_temperature > 0)
      core::log::warning(core::format(
          "surface '%s': from %td of its %td elements more heat is taken than reaches them: they have no temperature",
          s.name.c_str(), s.without_temperature, s.elements));
}

}  // namespace

ExitStatus exchange(const ExchangeOptions& options, const CommonOptions& common, Run& run) {
  const scene::Scene scene = read_to_solve(options.scene, SceneUse::exchange);
  warn_of_contacts(scene, *raycast::make_ray_caster("brute", scene));
  const results::OutputDirectory folder(options.out);
  const ThermalExchange found = fem::solve_exchange(scene, options.settings, options.environment, run);
  const results::Record record = record_of(found, options);
  results::write_atomically(options.out / "exchange.csv", csv_of(found));
  results::write_json(options.out / "exchange.json", record);
  write_fields(options.out / "exchange.vtu", found);
#ifdef INTERFLECT_WITH_VTK
  if (options.pictures) write_pictures(options.out, scene, found);
#endif
  warn_of(found, options.settings);
  if (common.json)
    std::printf("%s\n", results::json_text(record).c_str());
  else if (!common.quiet)
    std::printf("%s\nsum of Q %s W (estimated); to the environment %s W by rays (their noise alone)\nwritten to %s\n",
                table_of(found).c_str(), with_error(found.emitted, found.emitted_error).c_str(),
                with_error(found.to_environment, found.to_environment_error).c_str(), options.out.string().c_str());
  return shortfalls_of(found.solution, options.settings).empty() ? success : not_met;
}

}  // namespace interflect::apps
