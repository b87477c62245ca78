#pragma once

#include <string>
#include <vector>

#include "fem/radiosity.h"

namespace interflect::fem {

/// Means over an area, with half the widths of their 95 % intervals: all follow from that of H, its estimated bound +
/// 1.96 standard errors, and are 0 of what was given.
struct ThermalState {
  double temperature = 0;  ///< [K]: given, or found from the heat flux; of the mean of T^4
  double heat_flux = 0;    ///< q [W/m²], net, leaving: found, or given
  double radiosity = 0;    ///< B [W/m²]
  double irradiance = 0;   ///< H [W/m²]
  double temperature_error = 0, heat_flux_error = 0, radiosity_error = 0, irradiance_error = 0;
};

/// Net radiative exchange of a side of a surface, means over its area.
struct ThermalSurface : ThermalState {
  std::string name;
  double area = 0;          ///< [m²]
  double emissivity = 0;    ///< hemispherical, total; the surface is grey: absorptance and emissivity are equal
  bool flux_given = false;  ///< else the temperature
  Index elements = 0, without_temperature = 0;  ///< how many, and how many of which more is taken than reaches them

  double flux() const { return area * heat_flux; }  ///< Q = q A, net, leaving [W]
  double flux_error() const { return area * heat_flux_error; }
};

struct ThermalExchange {
  std::vector<ThermalSurface> surfaces;
  std::vector<ThermalState> elements;  ///< of solution.mesh; a temperature is NaN where more is taken than arrives
  double emitted = 0;                  ///< sum q A over the surfaces, net [W]: what goes to the environment
  double to_environment = 0;           ///< the same found from what leaves through openings, and onto black backs [W]
  double emitted_error = 0;            ///< of the sum, by those of the surfaces: estimated, 95 % [W]
  double to_environment_error = 0;     ///< of what rays found of it, 95 %, at most [W]; not of the radiosity they carry
  scene::Scene problem;                ///< what `solution` solves: see solve_exchange
  RadiositySolution solution;
};

/// Grey diffuse surfaces, each with a temperature or a net heat flux [Gebhart 1961; Hottel, Sarofim 1967]:
///
///   B = e sigma T^4 + (1 - e) H    where T is given
///   B = q + H                      where q = B - H is,   and then   sigma T^4 = H + q / e
///
/// The environment is black and at `environment` [K]: what surfaces see of it sends them sigma T_0^4.  All of it is
/// radiosity of exitances e sigma (T^4 - T_0^4) and q in a cold environment, shifted by sigma T_0^4, since a uniform
/// field is a solution.  Exitances below 0 are solved for by their sizes in a channel of their own, and the field is
/// that of the first channel less that of the second: errors are estimated of light, which is nowhere negative, and
/// those of both add up.
///
/// Errors follow from that of H: of B (1 - e) dH and of q e dH where T is given; where q is, of B dH, and of T the
/// farther end of what H +- dH makes of it.
/// @param settings  as of a solve; elements as there
/// @throws core::InputError  a scene of more than one channel, a photometric one, a material without `emissivity`, or
///                           heat fluxes alone in a closed scene, which have no answer; or exitances below 0 where the
///                           build has spectra of one channel
ThermalExchange solve_exchange(const scene::Scene& scene, const RadiositySettings& settings, double environment,
                               Run& run);

}  // namespace interflect::fem
