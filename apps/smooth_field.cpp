#include "apps/smooth_field.h"

#include "results/vtu.h"

namespace interflect::apps {

std::optional<SmoothField> smooth_field(const fem::RadiositySolution& solution) {
  if (!solution.field) return std::nullopt;
  const fem::PolynomialField& field = *solution.field;
  SmoothField out{mesh::smooth_mesh(solution.mesh), {}, {}};
  out.radiosity =
      mesh::smoothed<Spectrum>(out.mesh, [&](std::uint32_t element, const Vec3& x) { return field.at(element, x); });
  out.irradiance = mesh::smoothed<Spectrum>(
      out.mesh, [&](std::uint32_t element, const Vec3& x) { return field.irradiance_at(element, x); });
  return out;
}

void write_smooth_field(const std::filesystem::path& file, const SmoothField& field, const scene::Scene& scene) {
  const std::vector<results::CellField> of_points{
      results::spectrum_field("radiosity", field.radiosity, scene.channels),
      results::spectrum_field("irradiance", field.irradiance, scene.channels)};
  results::write_vtu(file, field.mesh, of_points);
}

}  // namespace interflect::apps
