#include "fem/thermal_exchange.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/estimate.h"

namespace interflect::fem {

namespace {

double fourth(double x) { return x * x * x * x; }

/// "'floor', 'walls'", each once; at most three of them.
std::string materials_without_heat(const scene::Scene& scene) {
  std::vector<std::string> names;
  for (const scene::SurfaceId id : scene.surface_ids())
    if (const scene::Material& material = scene.material(id); !material.thermal) {
      const std::string name = "'" + core::single_line(material.name) + "'";
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  std::string list;
  for (std::size_t k = 0; k < names.size() && k < 3; ++k) list += (k == 0 ? "" : ", ") + names[k];
  return list + (names.size() > 3 ? ", .." : "");
}

void require_thermal(const scene::Scene& scene) {
  const std::string shown = scene.file.empty() ? "scene" : scene.file.string();
  if (const std::string names = materials_without_heat(scene); !names.empty())
    throw core::InputError(shown,
                           "an exchange needs an emissivity, with a temperature or a heat_flux, of every material: "
                           "missing of " +
                               names);
  if (scene.channel_count() != 1 || scene.quantity != scene::Quantity::radiometric)
    throw core::InputError(shown, "an exchange needs \"quantity\": \"radiometric\" and one channel");
  const auto ids = scene.surface_ids();
  const auto has_temperature = [&](scene::SurfaceId id) { return scene.material(id).thermal->temperature.has_value(); };
  if (std::none_of(ids.begin(), ids.end(), has_temperature))
    throw core::InputError(shown, "no surface has a temperature: heat fluxes alone have no answer");
}

/// The radiosity problem whose field is the thermal one less sigma T_0^4.
scene::Scene shifted(scene::Scene scene, double environment) {
  for (scene::Material& material : scene.materials) {
    if (!material.thermal) continue;
    const scene::Thermal& thermal = *material.thermal;
    const double e = thermal.emissivity;
    if (thermal.temperature) {
      material.reflectance[0] = 1 - e;
      material.exitance[0] = e * scene::stefan_boltzmann * (fourth(*thermal.temperature) - fourth(environment));
    } else {
      material.reflectance[0] = 1;
      material.exitance[0] = thermal.heat_flux;
    }
  }
  return scene;
}

/// @param radiosity, irradiance  of the problem that was shifted [W/m²]
ThermalState state_of(const scene::Thermal& thermal, double radiosity, double irradiance, double environment) {
  const double background = scene::stefan_boltzmann * fourth(environment);
  ThermalState state{0, thermal.heat_flux, radiosity + background, irradiance + background};
  if (thermal.temperature) {
    state.temperature = *thermal.temperature;
    state.heat_flux = thermal.emissivity * (scene::stefan_boltzmann * fourth(state.temperature) - state.irradiance);
  } else {
    const double black = state.irradiance + state.heat_flux / thermal.emissivity;  // sigma T^4
    state.temperature = std::sqrt(std::sqrt(black / scene::stefan_boltzmann));
  }
  return state;
}

ThermalSurface surface_of(const scene::Scene& scene, const RadiositySolution& s, const mesh::ElementMesh::Part& part,
                          double environment) {
  ThermalSurface out;
  double radiosity = 0, irradiance = 0, error = 0;
  for (std::size_t i = part.first; i < std::size_t{part.first} + part.count; ++i) {
    const double area = s.mesh.patches()[i].area;
    out.area += area;
    radiosity += area * s.radiosity[i][0];
    irradiance += area * s.irradiance[i][0];
    error += area * (s.irradiance_error[i][0] + normal_95 * s.irradiance_noise[i][0]);
  }
  const scene::Thermal& thermal = *scene.material(part.surface).thermal;
  static_cast<ThermalState&>(out) = state_of(thermal, radiosity / out.area, irradiance / out.area, environment);
  out.name = scene.side_name(part.surface, part.side);
  out.emissivity = thermal.emissivity;
  out.flux_given = !thermal.temperature;
  out.elements = part.count;
  error /= out.area;
  if (!out.flux_given) {
    out.heat_flux_error = out.emissivity * error;
  } else if (!std::isnan(out.temperature)) {
    out.temperature_error = error / (4 * scene::stefan_boltzmann * out.temperature * out.temperature * out.temperature);
  } else {
    throw core::InputError("surface '" + out.name + "'",
                           "more heat is taken from it than reaches it: no temperature is cold enough");
  }
  return out;
}

std::vector<ThermalState> states_of(const scene::Scene& scene, const RadiositySolution& s, double environment) {
  std::vector<ThermalState> states;
  for (std::size_t i = 0; i < s.radiosity.size(); ++i)
    states.push_back(state_of(*scene.material(s.mesh.patches()[i].surface).thermal, s.radiosity[i][0],
                              s.irradiance[i][0], environment));
  return states;
}

}  // namespace

ThermalExchange solve_exchange(const scene::Scene& scene, const RadiositySettings& settings, double environment,
                               Run& run) {
  require_thermal(scene);
  ThermalExchange out{{}, {}, 0, 0, 0, 0, solve_radiosity(shifted(scene, environment), settings, run)};
  const RadiositySolution& s = out.solution;
  for (const mesh::ElementMesh::Part& part : s.mesh.parts()) {
    out.surfaces.push_back(surface_of(scene, s, part, environment));
    out.emitted += out.surfaces.back().area * out.surfaces.back().heat_flux;
    out.emitted_error += out.surfaces.back().area * out.surfaces.back().heat_flux_error;
  }
  out.elements = states_of(scene, s, environment);
  for (std::size_t k = 0; k < out.surfaces.size(); ++k) {
    const mesh::ElementMesh::Part& part = s.mesh.parts()[k];
    const auto first = out.elements.begin() + part.first;
    out.surfaces[k].without_temperature = std::count_if(
        first, first + part.count, [](const ThermalState& state) { return std::isnan(state.temperature); });
  }
  out.to_environment = s.energy.escaped[0] + s.energy.on_backs[0] + s.energy.in_mirrors[0];
  out.to_environment_error = normal_95 * s.energy.split_error[0];
  return out;
}

}  // namespace interflect::fem
