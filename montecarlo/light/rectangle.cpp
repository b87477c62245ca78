#include "montecarlo/light/rectangle.h"

namespace interflect::montecarlo {

RectangleLight::RectangleLight(const Vec3& corner, const Vec3& u, const Vec3& v, const Vec3& normal,
                               const Spectrum& exitance)
    : FlatLight(normal, u.norm() * v.norm(), exitance, corner + (u + v) / 2, (u + v).norm()),
      corner_(corner),
      u_(u),
      v_(v),
      a_(u.norm()),
      b_(v.norm()),
      x_(u / a_),
      y_(v / b_) {}

std::optional<Arriving> RectangleLight::arriving_within(const SphericalRectangle& seen, const Vec3& x, double u,
                                                        double v) const {
  const Vec2 y = seen.point(u, v);
  return arriving(x, corner_ + y.x() * x_ + y.y() * y_, 1 / seen.solid_angle());
}

LightExtent RectangleLight::extent() const {
  geometry::Box box;
  for (const Vec3& x : {corner_, Vec3(corner_ + u_), Vec3(corner_ + v_), Vec3(corner_ + u_ + v_)}) box.extend(x);
  return extent_of(box);
}

bool is_rectangle(std::span<const Vec3> ring, double angle) {
  if (ring.size() != 4) return false;
  const Vec3 u = ring[1] - ring[0], v = ring[3] - ring[0];
  const double a = u.norm(), b = v.norm();
  return std::abs(u.dot(v)) <= angle * a * b && (ring[2] - (ring[0] + u + v)).norm() <= angle * std::min(a, b);
}

}  // namespace interflect::montecarlo
