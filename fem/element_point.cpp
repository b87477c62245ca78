#include "fem/element_point.h"

namespace interflect::fem {

ElementMap::ElementMap(const scene::SurfacePatch& patch)
    : triangle_(patch.corners == 3),
      corner_(patch.corner[0]),
      along_s_(patch.corner[1] - corner_),
      along_t_((triangle_ ? patch.corner[2] : patch.corner[3]) - corner_) {
  if (triangle_) return;
  twist_ = patch.corner[2] - patch.corner[1] - along_t_;
  const Vec3 normal = along_s_.cross(along_t_), per_area = normal / (normal.norm() * patch.area);
  weight_ = per_area.dot(normal);
  weight_s_ = per_area.dot(along_s_.cross(twist_));
  weight_t_ = per_area.dot(twist_.cross(along_t_));
}

}  // namespace interflect::fem
