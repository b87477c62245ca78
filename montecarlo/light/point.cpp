#include "montecarlo/light/point.h"

#include "montecarlo/warp/cone.h"

namespace interflect::montecarlo {

std::optional<Arriving> PointSource::sample_arriving(const Place& at, double, double) const {
  const Vec3 way = light_.position - at.position;
  const double square = way.squaredNorm(), r = std::sqrt(square);
  if (!(r > 0)) return std::nullopt;
  return Arriving{way / r, r, light_.position, Vec3::Zero(), light_.intensity / square, 0};
}

Emission PointSource::sample_emission(const std::array<double, 4>& u) const {
  return {light_.position, Vec3::Zero(), uniform_cone(2, u[2], u[3]), flux(), 1, inv_pi / 4};
}

LightExtent PointSource::extent() const {
  return {{light_.position, light_.position}, Vec3::UnitZ(), -1, 0, light_.intensity.max()};
}

}  // namespace interflect::montecarlo
