#include "montecarlo/light/environment.h"

namespace interflect::montecarlo {
namespace {

std::vector<double> weights_of(const scene::EnvironmentMap& map) {
  std::vector<double> weights;
  for (int r = 0; r < map.rows(); ++r)
    for (int c = 0; c < map.columns(); ++c) weights.push_back(map.texel(r, c).max() * map.solid_angle(r));
  return weights;
}

}  // namespace

EnvironmentLight::EnvironmentLight(const scene::EnvironmentMap& map, const geometry::Box& box)
    : LightFromAfar(box), map_(map), table_(map.rows(), map.columns(), weights_of(map)) {
  for (int r = 0; r < map.rows(); ++r)
    for (int c = 0; c < map.columns(); ++c) {
      integral_ += map.texel(r, c) * map.solid_angle(r);
      brightest_ = max(brightest_, map.texel(r, c));
    }
}

EnvironmentLight::Drawn EnvironmentLight::drawn(double u, double v) const {
  const auto [row, column] = table_.pick(u, v);
  const double above = map_.row_cosine(row.cell), below = map_.row_cosine(row.cell + 1);
  return {map_.direction(above + row.within * (below - above), (column.cell + column.within) / map_.columns()),
          map_.texel(row.cell, column.cell), pdf_of(row.cell, column.cell)};
}

std::optional<Arriving> EnvironmentLight::sample_arriving(const Place&, double u, double v) const {
  const auto [way, radiance, pdf] = drawn(u, v);
  return arriving(way, radiance, pdf);
}

double EnvironmentLight::pdf_arriving_solid_angle(const Place&, const Vec3& way, const Vec3&) const {
  const auto [row, column] = map_.at(way);
  return pdf_of(row, column);
}

Emission EnvironmentLight::sample_emission(const std::array<double, 4>& u) const {
  const auto [from, radiance, pdf] = drawn(u[2], u[3]);
  return emission(-from, radiance * (disk_area() / pdf), pdf, u[0], u[1]);
}

EmissionPdfs EnvironmentLight::pdfs_emission(const Vec3& position, const Vec3& way) const {
  return {1 / disk_area(), pdf_arriving_solid_angle({position, Vec3::Zero()}, -way, position)};
}

}  // namespace interflect::montecarlo
