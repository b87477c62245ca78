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

/// Channels of the problem that is solved: what gives more than the environment would, and what gives less.
constexpr int above = 0, below = 1;

/// E of a material, less what one at the temperature of the environment emits [W/m²].
double shifted_exitance(const scene::Thermal& thermal, double environment) {
  if (!thermal.temperature) return thermal.heat_flux;
  return thermal.emissivity * scene::stefan_boltzmann * (fourth(*thermal.temperature) - fourth(environment));
}

/// The radiosity problem whose field is the thermal one less sigma T_0^4, in one channel where that is nowhere below 0.
scene::Scene shifted(scene::Scene scene, double environment) {
  const auto gives_less = [&](scene::SurfaceId id) {
    return shifted_exitance(*scene.material(id).thermal, environment) < 0;
  };
  const auto ids = scene.surface_ids();
  scene.channels = {"above the environment"};
  if (std::any_of(ids.begin(), ids.end(), gives_less)) scene.channels.emplace_back("below it");
  if (scene.channel_count() > Spectrum::capacity)
    throw core::InputError("exchange",
                           "surfaces above and below the environment need spectra of two channels: a build "
                           "with INTERFLECT_SPECTRUM_CAPACITY of 2 or more expected");
  for (scene::Material& material : scene.materials) {
    if (!material.thermal) continue;
    const double E = shifted_exitance(*material.thermal, environment);
    material.exitance = Spectrum::zero();
    for (int c = 0; c < scene.channel_count(); ++c) {
      scene.weights[c] = 1;
      material.reflectance[c] = material.thermal->temperature ? 1 - material.thermal->emissivity : 1;
      material.exitance[c] = std::max(0.0, c == above ? E : -E);
    }
  }
  return scene;
}

/// What a spectrum of the shifted problem comes to, and what its errors do.
double net(const Spectrum& s) { return Spectrum::capacity > below ? s[above] - s[below] : s[above]; }
double both(const Spectrum& s) { return Spectrum::capacity > below ? s[above] + s[below] : s[above]; }

double temperature_of(double black) { return std::sqrt(std::sqrt(black / scene::stefan_boltzmann)); }

/// Of what has the black emission sigma T^4 = black +- error: to the farther end.
double temperature_error(double black, double error) {
  const double lowest = black > error ? temperature_of(black - error) : 0;
  return std::max(temperature_of(black) - lowest, temperature_of(black + error) - temperature_of(black));
}

/// Of what an error is multiplied with; of 0 nothing remains, even of one that is not known.
double part_of(double factor, double error) { return factor == 0 ? 0 : factor * error; }

/// B and H of the shifted problem, and the half width of a 95 % interval of H [W/m²].
struct Shifted {
  double radiosity = 0, irradiance = 0, error = 0;

  void add(double area, const RadiositySolution& s, std::size_t element) {
    radiosity += area * net(s.radiosity[element]);
    irradiance += area * net(s.irradiance[element]);
    error += area * both(s.irradiance_error[element] + normal_95 * s.irradiance_noise[element]);
  }
};

ThermalState state_of(const scene::Thermal& thermal, const Shifted& found, double environment) {
  const double background = scene::stefan_boltzmann * fourth(environment), e = thermal.emissivity;
  ThermalState state;
  state.radiosity = found.radiosity + background;
  state.irradiance = found.irradiance + background;
  state.irradiance_error = found.error;
  if (thermal.temperature) {
    state.temperature = *thermal.temperature;
    state.heat_flux = e * (scene::stefan_boltzmann * fourth(state.temperature) - state.irradiance);
    state.heat_flux_error = e * found.error;
    state.radiosity_error = part_of(1 - e, found.error);
  } else {
    const double black = state.irradiance + thermal.heat_flux / e;
    state.heat_flux = thermal.heat_flux;
    state.temperature = temperature_of(black);
    state.temperature_error = temperature_error(black, found.error);
    state.radiosity_error = found.error;
  }
  return state;
}

ThermalSurface surface_of(const scene::Scene& scene, const RadiositySolution& s, const mesh::ElementMesh::Part& part,
                          double environment) {
  ThermalSurface out;
  Shifted sum;
  for (std::size_t i = part.first; i < std::size_t{part.first} + part.count; ++i) {
    out.area += s.mesh.patches()[i].area;
    sum.add(s.mesh.patches()[i].area, s, i);
  }
  const scene::Thermal& thermal = *scene.material(part.surface).thermal;
  static_cast<ThermalState&>(out) =
      state_of(thermal, {sum.radiosity / out.area, sum.irradiance / out.area, sum.error / out.area}, environment);
  out.name = scene.side_name(part.surface, part.side);
  out.emissivity = thermal.emissivity;
  out.flux_given = !thermal.temperature;
  out.elements = part.count;
  if (std::isnan(out.temperature))
    throw core::InputError("surface '" + out.name + "'",
                           "more heat is taken from it than reaches it: no temperature is cold enough");
  return out;
}

std::vector<ThermalState> states_of(const scene::Scene& scene, const RadiositySolution& s, double environment) {
  std::vector<ThermalState> states;
  for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
    Shifted found;
    found.add(1, s, i);
    states.push_back(state_of(*scene.material(s.mesh.patches()[i].surface).thermal, found, environment));
  }
  return states;
}

}  // namespace

ThermalExchange solve_exchange(const scene::Scene& scene, const RadiositySettings& settings, double environment,
                               Run& run) {
  require_thermal(scene);
  scene::Scene problem = shifted(scene, environment);
  RadiositySolution solution = solve_radiosity(problem, settings, run);
  ThermalExchange out{{}, {}, 0, 0, 0, 0, std::move(problem), std::move(solution)};
  const RadiositySolution& s = out.solution;
  for (const mesh::ElementMesh::Part& part : s.mesh.parts()) {
    out.surfaces.push_back(surface_of(scene, s, part, environment));
    out.emitted += out.surfaces.back().flux();
    out.emitted_error += out.surfaces.back().flux_error();
  }
  out.elements = states_of(scene, s, environment);
  for (std::size_t k = 0; k < out.surfaces.size(); ++k) {
    const mesh::ElementMesh::Part& part = s.mesh.parts()[k];
    const auto first = out.elements.begin() + part.first;
    out.surfaces[k].without_temperature = std::count_if(
        first, first + part.count, [](const ThermalState& state) { return std::isnan(state.temperature); });
  }
  out.to_environment = net(s.energy.escaped + s.energy.on_backs + s.energy.in_mirrors);
  out.to_environment_error = normal_95 * both(s.energy.split_error);
  return out;
}

}  // namespace interflect::fem
