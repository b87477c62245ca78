#include "results/tables.h"

#include <array>
#include <limits>
#include <utility>

#include "core/error.h"
#include "results/atomic_file.h"
#include "results/csv.h"

namespace interflect::results {

Spectrum error_95(const Estimate& estimate) { return estimate.error_bound + estimate.standard_error * normal_95; }

Spectrum reflected_error(const Spectrum& reflectance, const Spectrum& irradiance_error) {
  Spectrum error;
  for (int c = 0; c < Spectrum::capacity; ++c)
    error[c] = reflectance[c] == 0 ? 0 : reflectance[c] * irradiance_error[c];
  return error;
}

std::vector<SurfaceRow> surface_means(const scene::Scene& scene, const mesh::ElementMesh& mesh,
                                      const ElementValues& of) {
  const auto size = static_cast<std::size_t>(mesh.size());
  if (of.radiosity.size() != size || of.irradiance.size() != size || of.radiosity_error.size() != size ||
      of.irradiance_error.size() != size)
    throw core::PreconditionError("surface_means: one value per element expected");
  std::vector<SurfaceRow> rows;
  for (const mesh::ElementMesh::Part& part : mesh.parts()) {
    SurfaceRow row{scene.side_name(part.surface, part.side), 0, {}, {}, {}, {}};
    for (std::size_t i = part.first; i < std::size_t{part.first} + part.count; ++i) {
      const double area = mesh.patches()[i].area;
      row.area += area;
      row.radiosity += of.radiosity[i] * area;
      row.irradiance += of.irradiance[i] * area;
      row.radiosity_error += of.radiosity_error[i] * area;
      row.irradiance_error += of.irradiance_error[i] * area;
    }
    for (Spectrum* sum : {&row.radiosity, &row.irradiance, &row.radiosity_error, &row.irradiance_error})
      *sum /= row.area;
    rows.push_back(row);
  }
  return rows;
}

SurfaceRow surface_row(const scene::Scene& scene, scene::SurfaceId surface, scene::Side side,
                       const Estimate& irradiance) {
  const scene::Material& material = scene.material(surface);
  const Spectrum rho = material.reflectance_of(side), error = error_95(irradiance);
  SurfaceRow row{scene.side_name(surface, side),
                 scene.area(surface),
                 material.exitance_of(side) + rho * irradiance.value,
                 irradiance.value,
                 reflected_error(rho, error),
                 error};
  if (!material.is_diffuse()) {
    row.radiosity = Spectrum(std::numeric_limits<double>::quiet_NaN());
    row.radiosity_error = Spectrum(std::numeric_limits<double>::infinity());
  }
  return row;
}

std::string surfaces_csv(std::span<const SurfaceRow> rows, const scene::Scene& scene) {
  const int channels = scene.channel_count();
  constexpr std::array columns{
      std::pair{"radiosity", &SurfaceRow::radiosity}, std::pair{"irradiance", &SurfaceRow::irradiance},
      std::pair{"error", &SurfaceRow::radiosity_error}, std::pair{"irradiance_error", &SurfaceRow::irradiance_error}};
  Csv csv;
  csv.text("name").text("area");
  for (const auto& [name, values] : columns) csv.headings(name, channels);
  for (const auto& [name, values] : columns) csv.text(name);
  csv.end_line();
  for (const SurfaceRow& row : rows) {
    csv.text(row.name).number(row.area);
    for (const auto& [name, values] : columns) csv.numbers(row.*values, channels);
    for (const auto& [name, values] : columns) csv.number(scene.weigh(row.*values));
    csv.end_line();
  }
  return csv.str();
}

void write_surfaces_csv(const std::filesystem::path& file, std::span<const SurfaceRow> rows,
                        const scene::Scene& scene) {
  write_atomically(file, surfaces_csv(rows, scene));
}

std::string sensors_csv(std::span<const measure::SensorPoint> points, std::span<const Estimate> values,
                        const scene::Scene& scene, std::span<const Interval> bounds) {
  if (points.size() != values.size()) throw core::PreconditionError("sensors_csv: one value per point expected");
  if (!bounds.empty() && points.size() != bounds.size())
    throw core::PreconditionError("sensors_csv: bounds of all points or of none expected");
  const int channels = scene.channel_count();
  Csv csv;
  for (const char* heading : {"sensor", "index", "x", "y", "z", "nx", "ny", "nz"}) csv.text(heading);
  csv.headings("value", channels).headings("error", channels);
  if (!bounds.empty()) csv.headings("lower", channels).headings("upper", channels);
  csv.text("value").text("error");
  if (!bounds.empty()) csv.text("lower").text("upper");
  csv.end_line();
  for (std::size_t i = 0; i < points.size(); ++i) {
    csv.text(points[i].sensor).integer(points[i].index);
    for (const Vec3& v : {points[i].at.position, points[i].at.normal}) csv.number(v.x()).number(v.y()).number(v.z());
    const Spectrum error = error_95(values[i]);
    csv.numbers(values[i].value, channels).numbers(error, channels);
    if (!bounds.empty()) csv.numbers(bounds[i].lower, channels).numbers(bounds[i].upper, channels);
    csv.number(scene.weigh(values[i].value)).number(scene.weigh(error));
    if (!bounds.empty()) csv.number(scene.weigh(bounds[i].lower)).number(scene.weigh(bounds[i].upper));
    csv.end_line();
  }
  return csv.str();
}

void write_sensors_csv(const std::filesystem::path& file, std::span<const measure::SensorPoint> points,
                       std::span<const Estimate> values, const scene::Scene& scene, std::span<const Interval> bounds) {
  write_atomically(file, sensors_csv(points, values, scene, bounds));
}

}  // namespace interflect::results
