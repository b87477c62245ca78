#include "montecarlo/measured_patches.h"

namespace interflect::montecarlo {
namespace {

constexpr double relative_thickness = 1e-6;  ///< of a patch's extent

std::size_t slot(scene::SurfaceId surface, scene::Side side) {
  return 2 * std::size_t{surface.value} + (side == scene::Side::back ? 1 : 0);
}

bool holds(std::span<const Vec3> ring, const Vec3& normal, double thickness, const Vec3& x) {
  if (!(std::abs(normal.dot(x - ring[0])) <= thickness)) return false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec3& from = ring[k];
    if (normal.dot((ring[(k + 1) % ring.size()] - from).cross(x - from)) < 0) return false;
  }
  return true;
}

}  // namespace

MeasuredPatches::MeasuredPatches(std::span<const measure::Measurement> asked) {
  for (std::uint32_t m = 0; m < asked.size(); ++m) {
    if (const auto* mean = std::get_if<measure::PatchIrradiance>(&asked[m]))
      add(mean->patch, {m, 1 / mean->patch.area});
    else if (const auto* flux = std::get_if<measure::Flux>(&asked[m]))
      for (const scene::SurfacePatch& patch : flux->through) add(patch, {m, 1});
  }
  for (Part& part : parts_) {
    std::vector<geometry::Box> boxes;
    for (const Patch& each : part.patches) {
      const geometry::Box box = geometry::box_of(each.patch.ring());
      const Vec3 margin = Vec3::Constant(each.thickness);
      boxes.emplace_back(box.min() - margin, box.max() + margin);
    }
    part.grid = geometry::BoxGrid(boxes);
  }
}

void MeasuredPatches::add(const scene::SurfacePatch& patch, const Share& share) {
  const std::size_t at = slot(patch.surface, patch.side);
  if (at >= parts_.size()) parts_.resize(at + 1);
  const double extent = geometry::box_of(patch.ring()).diagonal().norm();
  parts_[at].patches.push_back({patch, patch.normal(), relative_thickness * extent, share});
}

void MeasuredPatches::at(const scene::SurfacePoint& point, std::vector<Share>& found) const {
  found.clear();
  const std::size_t at = slot(point.surface, point.side);
  if (at >= parts_.size()) return;
  for (const std::uint32_t k : parts_[at].grid.near(point.position)) {
    const Patch& each = parts_[at].patches[k];
    if (holds(each.patch.ring(), each.normal, each.thickness, point.position)) found.push_back(each.share);
  }
}

}  // namespace interflect::montecarlo
