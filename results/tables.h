#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/estimate.h"
#include "core/interval.h"
#include "measure/sensor_points.h"
#include "mesh/element_mesh.h"
#include "scene/scene.h"

/// The tables of a run; every method writes the same columns, so that runs join on the name.
namespace interflect::results {

/// Half the width of a 95 % interval: error_bound + normal_95 standard errors, per channel.  Infinite where the bound
/// is.
Spectrum error_95(const Estimate& estimate);

/// Half the width of an interval of rho H from that of H: 0 where nothing is reflected, even if H is not known.
Spectrum reflected_error(const Spectrum& reflectance, const Spectrum& irradiance_error);

/// A side of a surface: area means [W/m² | lm/m², lx], and half the widths of their 95 % intervals.
struct SurfaceRow {
  std::string name;  ///< of the side
  double area;       ///< [m²]
  Spectrum radiosity, irradiance;
  Spectrum radiosity_error, irradiance_error;
};

/// What is known of each element of a mesh.
struct ElementValues {
  std::span<const Spectrum> radiosity, irradiance;
  std::span<const Spectrum> radiosity_error, irradiance_error;  ///< half the widths of 95 % intervals
};

/// Means over each part of a mesh.  The error of a mean is at most the mean of the errors.
std::vector<SurfaceRow> surface_means(const scene::Scene& scene, const mesh::ElementMesh& mesh,
                                      const ElementValues& of);

/// A row from an estimate of the mean irradiance of a side: B = E + rho H, and rho times its error.  What leaves a
/// mirror, glass, a coat or a net is more than that: NaN, and an infinite error.
SurfaceRow surface_row(const scene::Scene& scene, scene::SurfaceId surface, scene::Side side,
                       const Estimate& irradiance);

/// `name,area`, then `radiosity_0,..,irradiance_0,..,error_0,..,irradiance_error_0,..` of each channel of the
/// scene, and `radiosity,irradiance,error,irradiance_error` weighed over them (lx), a line a row; `error` is of the
/// radiosity.
std::string surfaces_csv(std::span<const SurfaceRow> rows, const scene::Scene& scene);
void write_surfaces_csv(const std::filesystem::path& file, std::span<const SurfaceRow> rows, const scene::Scene& scene);

/// `sensor,index,x,y,z,nx,ny,nz,value_0,..,error_0,..,value,error`, a line a point; with bounds `lower_0,..,upper_0,..`
/// before the last two, and `lower,upper` behind them.
/// @param bounds  proved ones of the points; or none
std::string sensors_csv(std::span<const measure::SensorPoint> points, std::span<const Estimate> values,
                        const scene::Scene& scene, std::span<const Interval> bounds = {});
void write_sensors_csv(const std::filesystem::path& file, std::span<const measure::SensorPoint> points,
                       std::span<const Estimate> values, const scene::Scene& scene,
                       std::span<const Interval> bounds = {});

}  // namespace interflect::results
