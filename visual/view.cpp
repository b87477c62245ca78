#include "visual/view.h"

#include <algorithm>
#include <cmath>

namespace interflect::visual {

scene::Camera outside_view(const scene::Scene& scene, int width, int height) {
  constexpr double fov_deg = 28, margin = 1.06;
  const Vec3 up = scene.up.normalized();
  const Vec3 right = std::abs(up.x()) < 0.9 ? (Vec3::UnitX() - up.x() * up).normalized() : Vec3(Vec3::UnitY());
  const Vec3 towards_viewer = right.cross(up);  // -y where up is z
  const Vec3 from = (0.42 * right + 0.9 * towards_viewer + 0.55 * up).normalized();

  const auto box = scene.box();
  const Vec3 centre = 0.5 * (box.min() + box.max());
  const Vec3 image_x = up.cross(from).normalized(), image_y = from.cross(image_x);
  const double tan_y = std::tan(0.5 * fov_deg * pi / 180), tan_x = tan_y * width / height;
  // Each side of the picture asks of each corner q:
  //   +-(q - target) . image / tan <= (distance - (q - target) . from) / margin.
  // Moving the target sideways until opposite sides ask for the same distance centres the box.
  Vec3 target = centre;
  double distance = 0;
  for (int pass = 0; pass < 20; ++pass) {
    double left = 0, right_side = 0, below = 0, above = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p((corner & 1 ? box.max() : box.min()).x(), (corner & 2 ? box.max() : box.min()).y(),
                   (corner & 4 ? box.max() : box.min()).z());
      const Vec3 q = p - target;
      const double x = margin * q.dot(image_x) / tan_x, y = margin * q.dot(image_y) / tan_y, near = q.dot(from);
      left = std::max(left, near - x);
      right_side = std::max(right_side, near + x);
      below = std::max(below, near - y);
      above = std::max(above, near + y);
    }
    distance = std::max({left, right_side, below, above});
    target += 0.5 / margin * ((right_side - left) * tan_x * image_x + (above - below) * tan_y * image_y);
  }
  return {"outside", target + distance * from, target, up, fov_deg, width, height};
}

}  // namespace interflect::visual
