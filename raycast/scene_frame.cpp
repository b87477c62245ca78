#include "raycast/scene_frame.h"

#include <algorithm>

namespace interflect::raycast {

SceneFrame frame_of(const scene::Scene& scene) {
  const geometry::Box box = scene.box();
  if (box.isEmpty()) return {};
  const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  return {.centre = box.center(), .size = box.sizes().maxCoeff(), .rounding = 0x1p-49 * largest};
}

scene::SurfacePoint surface_point(const scene::Facet& facet, std::uint32_t index, const Vec3& direction, double u,
                                  double v) {
  u = std::max(u, 0.0);
  v = std::max(v, 0.0);
  if (const double sum = u + v; sum > 1.0) u /= sum, v /= sum;
  const bool front = direction.dot(facet.normal) < 0;
  scene::SurfacePoint at;
  at.surface = facet.surface;
  at.side = front ? scene::Side::front : scene::Side::back;
  at.facet = index;
  at.uv = {u, v};
  // From the first corner on: the rounding error is that of the facet's size and of the coordinates, no more.
  at.position = facet.corner[0] + u * (facet.corner[1] - facet.corner[0]) + v * (facet.corner[2] - facet.corner[0]);
  at.normal = front ? facet.normal : Vec3(-facet.normal);
  return at;
}

}  // namespace interflect::raycast
