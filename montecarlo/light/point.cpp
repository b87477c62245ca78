#include "montecarlo/light/point.h"

#include "montecarlo/warp/cone.h"

namespace interflect::montecarlo {

Emission PointSource::sample_emission(const std::array<double, 4>& u) const {
  return {light_.position, Vec3::Zero(), uniform_cone(2, u[2], u[3]), flux(), 1, inv_pi / 4};
}

LightExtent PointSource::extent() const {
  return {{light_.position, light_.position}, Vec3::UnitZ(), -1, 0, light_.intensity.max()};
}

}  // namespace interflect::montecarlo
