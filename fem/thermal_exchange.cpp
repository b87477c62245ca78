#include "fem/thermal_exchange.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/estimate.h"

namespace interflect::fem {

namespace {

double fourth(double x) { return x * x * x * x; }

void require_thermal(const scene::Scene& scene) {
  if (scene.channel_count() != 1 || scene.quantity != scene::Quantity::radiometric)
    throw core::InputError("an exchange needs a radiometric scene of one channel");
  bool temperature = false;
  for (const scene::SurfaceId id : scene.surface_ids()) {
    const scene::Material& material = scene.material(id);
    if (!material.thermal)
      throw core::InputError("material '" + material.name + "'", "an emissivity with a temperature or a heat flux expected");
    temperature = temperature || material.thermal->temperature;
  }
  if (!temperature) throw core::InputError("no surface has a temperature: heat fluxes alone have no answer");
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

ThermalSurface surface_of(const scene::Scene& scene, const RadiositySolution& s, const mesh::ElementMesh::Part& part, double environment) {
  ThermalSurface out;
  const scene::Thermal& thermal = *scene.material(part.surface).thermal;
  out.name = scene.side_name(part.surface, part.side);
  out.emissivity = thermal.emissivity;
  double error = 0;
  for (std::size_t i = part.first; i < std::size_t{part.first} + part.count; ++i) {
    const double area = s.mesh.patches()[i].area;
    out.area += area;
    out.radiosity += area * s.radiosity[i][0];
    out.irradiance += area * s.irradiance[i][0];
    error += area * (s.irradiance_error[i][0] + normal_95 * s.irradiance_noise[i][0]);
  }
  const double background = scene::stefan_boltzmann * fourth(environment);
  out.radiosity = out.radiosity / out.area + background;
  out.irradiance = out.irradiance / out.area + background;
  error /= out.area;
  if (thermal.temperature) {
    out.temperature = *thermal.temperature;
    out.heat_flux = out.emissivity * (scene::stefan_boltzmann * fourth(out.temperature) - out.irradiance);
    out.heat_flux_error = out.emissivity * error;
    return out;
  }
  out.flux_given = true;
  out.heat_flux = thermal.heat_flux;
  const double black = out.irradiance + out.heat_flux / out.emissivity;  // sigma T^4
  if (!(black >= 0)) throw core::InputError("surface '" + out.name + "'", "more heat is taken from it than reaches it: no temperature is cold enough");
  out.temperature = std::sqrt(std::sqrt(black / scene::stefan_boltzmann));
  out.temperature_error = out.temperature * error / (4 * black);
  return out;
}

}  // namespace

ThermalExchange solve_exchange(const scene::Scene& scene, const RadiositySettings& settings, double environment, Run& run) {
  require_thermal(scene);
  ThermalExchange out{{}, 0, 0, solve_radiosity(shifted(scene, environment), settings, run)};
  const RadiositySolution& s = out.solution;
  for (const mesh::ElementMesh::Part& part : s.mesh.parts()) {
    out.surfaces.push_back(surface_of(scene, s, part, environment));
    out.emitted += out.surfaces.back().area * out.surfaces.back().heat_flux;
  }
  out.to_environment = s.energy.escaped[0] + s.energy.on_backs[0];
  return out;
}

}  // namespace interflect::fem
