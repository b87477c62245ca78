#include "fem/form_factor/element_locator.h"

#include <algorithm>
#include <limits>

namespace interflect::fem {
namespace {

constexpr double relative_thickness = 1e-6;  ///< of an element's extent

std::size_t slot(scene::SurfaceId surface, scene::Side side) {
  return 2 * std::size_t{surface.value} + (side == scene::Side::back ? 1 : 0);
}

}  // namespace

ElementLocator::Outline ElementLocator::outline_of(const scene::SurfacePatch& patch) {
  Outline o{
      patch.corner[0], patch.normal(), {}, {}, relative_thickness * geometry::box_of(patch.ring()).diagonal().norm()};
  o.inwards.fill(Vec3::Zero());
  for (std::size_t k = 0; k < patch.corners; ++k) {
    const Vec3 edge = patch.corner[(k + 1) % patch.corners] - patch.corner[k];
    o.inwards[k] = o.normal.cross(edge);
    o.offset[k] = o.inwards[k].dot(patch.corner[k] - o.corner);
  }
  return o;
}

ElementLocator::ElementLocator(std::span<const scene::SurfacePatch> patches) : mesh_({patches.begin(), patches.end()}) {
  std::vector<geometry::Box> boxes;
  for (const scene::SurfacePatch& patch : patches) {
    outlines_.push_back(outline_of(patch));
    geometry::Box box = geometry::box_of(patch.ring());
    const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
    const Vec3 margin = Vec3::Constant(outlines_.back().thickness + 0x1p-49 * largest);
    boxes.emplace_back(box.min() - margin, box.max() + margin);
  }
  for (const mesh::ElementMesh::Part& part : mesh_.parts()) {
    part_.resize(std::max(part_.size(), slot(part.surface, part.side) + 1), -1);
    part_[slot(part.surface, part.side)] = static_cast<std::int32_t>(grids_.size());
    grids_.emplace_back(std::span(boxes).subspan(part.first, part.count));
  }
}

Index ElementLocator::operator()(const scene::SurfacePoint& point) const {
  const std::size_t at = slot(point.surface, point.side);
  if (at >= part_.size() || part_[at] < 0) return none;
  const auto part = static_cast<std::size_t>(part_[at]);
  const Index first = mesh_.parts()[part].first;

  Index found = none;
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t item : grids_[part].near(point.position)) {
    const Outline& o = outlines_[static_cast<std::size_t>(first + item)];
    const Vec3 d = point.position - o.corner;
    if (!o.holds(d)) continue;
    const double height = std::abs(o.normal.dot(d));
    if (height <= o.thickness && height < least) least = height, found = first + item;
  }
  if (found != none) return found;
  const auto nearest = mesh_.locate(point);
  return nearest ? static_cast<Index>(nearest->element.value) : none;
}

}  // namespace interflect::fem
