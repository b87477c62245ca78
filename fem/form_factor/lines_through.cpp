#include "fem/form_factor/lines_through.h"

#include <algorithm>
#include <cmath>

#include "core/hemisphere.h"
#include "geometry/box.h"

namespace interflect::fem {

static scene::Side other(scene::Side side) {
  return side == scene::Side::front ? scene::Side::back : scene::Side::front;
}

LinesThrough::LinesThrough(std::span<const scene::SurfacePatch> patches, const raycast::RayCaster& rays,
                           const ElementLocator& locate)
    : rays_(rays), locate_(locate) {
  geometry::Box box;
  for (const scene::SurfacePatch& patch : patches)
    for (const Vec3& corner : patch.ring()) box.extend(corner);
  centre_ = box.center();
  for (const scene::SurfacePatch& patch : patches)
    for (const Vec3& corner : patch.ring()) radius_ = std::max(radius_, (corner - centre_).norm());
}

raycast::Ray LinesThrough::line(std::span<const double> u) const {
  const double z = 1 - 2 * u[0], across = std::sqrt(std::max(0.0, 1 - z * z)), from_axis = radius_ * std::sqrt(u[2]);
  const Vec3 direction(across * std::cos(2 * pi * u[1]), across * std::sin(2 * pi * u[1]), z);
  const core::Frame frame = core::frame_around(direction);
  return {centre_ + frame.to_world(
                        {from_axis * std::cos(2 * pi * u[3]), from_axis * std::sin(2 * pi * u[3]), -1.5 * radius_}),
          direction};
}

void LinesThrough::pairs_along(const raycast::Ray& line, std::vector<scene::SurfacePoint>& hits,
                               std::vector<Exchange>& pairs) const {
  pairs.clear();
  rays_.all(line, hits);
  for (std::size_t k = 1; k < hits.size(); ++k) {
    const scene::SurfacePoint& to = hits[k];
    // Surfaces that lie on each other do not exchange light through the nothing between them; nor do rays see each
    // other there.
    if ((to.position - hits[k - 1].position).norm() <= 2 * rays_.offset()) continue;
    scene::SurfacePoint from = hits[k - 1];
    from.side = other(from.side);
    const Index i = locate_(from);
    if (i == ElementLocator::none) continue;
    const Index j = locate_(to);
    if (j != ElementLocator::none && j != i) pairs.push_back({i, j});
  }
}

void LinesThrough::along(std::span<const double> u, std::vector<Exchange>& exchanges) const {
  std::vector<scene::SurfacePoint> hits;
  pairs_along(line(u), hits, exchanges);
}

}  // namespace interflect::fem
