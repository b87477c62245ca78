#include "fem/form_factor/plane_outlines.h"

#include <algorithm>
#include <cmath>

#include "core/hemisphere.h"
#include "geometry/box.h"

namespace interflect::fem {
namespace {

constexpr double relative_flatness = 1e-9, relative_margin = 1e-6;  ///< of the extent of all

}  // namespace

PlaneOutlines::PlaneOutlines(std::span<const scene::SurfacePatch> patches) {
  if (patches.empty()) return;
  geometry::Box box;
  for (const scene::SurfacePatch& patch : patches) box.extend(geometry::box_of(patch.ring()));
  const double extent = box.diagonal().norm();
  const core::Frame frame = core::frame_around(patches[0].normal());
  origin_ = box.center(), s_ = frame.s, t_ = frame.t;
  margin_ = static_cast<float>(relative_margin * extent);
  const double height = frame.n.dot(patches[0].corner[0]);
  std::vector<Outline> outlines;
  for (const scene::SurfacePatch& patch : patches) {
    Outline& o = outlines.emplace_back();
    for (std::size_t k = 0; k < patch.corners; ++k) {
      const Vec3 &from = patch.corner[k], edge = patch.corner[(k + 1) % patch.corners] - from;
      if (!(std::abs(frame.n.dot(from) - height) <= relative_flatness * extent)) return;
      const Vec3 inwards = frame.n.cross(edge).normalized();
      const auto at = static_cast<Index>(k);
      o.s[at] = static_cast<float>(s_.dot(inwards)), o.t[at] = static_cast<float>(t_.dot(inwards));
      o.offset[at] = static_cast<float>(inwards.dot(from - origin_));
    }
    if (!(patch.normal().dot(frame.n) > 0)) return;
  }
  outlines_ = std::move(outlines);
}

}  // namespace interflect::fem
