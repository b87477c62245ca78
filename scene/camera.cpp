#include "scene/camera.h"

#include <cmath>

namespace interflect::scene {

Vec3 Camera::direction(double x, double y) const {
  const Vec3 forward = (target - eye).normalized();
  const Vec3 right = forward.cross(up).normalized();
  const Vec3 above = right.cross(forward);
  const double half_height = std::tan(fov_y_deg * (pi / 360));
  const double half_width = half_height * width / height;
  return (forward + (2 * x / width - 1) * half_width * right + (1 - 2 * y / height) * half_height * above).normalized();
}

}  // namespace interflect::scene
