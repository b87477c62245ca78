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
  const double extent = geometry::box_of(patch.ring()).diagonal().norm();
  Outline o{patch.corner[0], patch.normal(), {}, {}, relative_thickness * extent, relative_thickness * extent * extent};
  o.inwards.fill(Vec3::Zero());
  o.offset.fill(-std::numeric_limits<double>::infinity());
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
    part_of_.resize(std::max(part_of_.size(), slot(part.surface, part.side) + 1), -1);
    part_of_[slot(part.surface, part.side)] = static_cast<std::int32_t>(parts_.size());
    parts_.push_back({part.first, geometry::BoxGrid(std::span(boxes).subspan(part.first, part.count)),
                      PlaneOutlines(patches.subspan(part.first, part.count))});
  }
}

ElementLocator::Guess ElementLocator::guess(const scene::SurfacePoint& point) const {
  const std::size_t at = slot(point.surface, point.side);
  if (at >= part_of_.size() || part_of_[at] < 0) return {};
  const Part& part = parts_[static_cast<std::size_t>(part_of_[at])];
  if (!part.outlines.flat()) return {&part};
  const Eigen::Vector2f x = part.outlines.at(point.position);
  return {&part, &part.outlines.likely(x), x};
}

/// The first of some that surely holds the point.  Inlined: it is asked of every ray, and mostly answers at once.
[[gnu::always_inline]] inline Index ElementLocator::sure_among(const Guess& guess,
                                                               std::span<const std::uint32_t> items) {
  for (const std::uint32_t item : items)
    if (item != PlaneOutlines::none && guess.part->outlines.surely_holds(item, guess.in_plane))
      return guess.part->first + item;
  return none;
}

Index ElementLocator::by(const Guess& guess, const scene::SurfacePoint& point) const {
  if (guess.part == nullptr) return none;
  const Index likely = guess.items != nullptr ? sure_among(guess, *guess.items) : none;
  return likely != none ? likely : among_near(guess, point);
}

Index ElementLocator::among_near(const Guess& guess, const scene::SurfacePoint& point) const {
  const Part& part = *guess.part;
  const std::span<const std::uint32_t> items = part.grid.near(point.position);
  const Index sure = part.outlines.flat() ? sure_among(guess, items) : none;
  return sure != none ? sure : nearest_among(part, items, point);
}

/// In double precision, and of several that hold it the one in whose plane it lies.
Index ElementLocator::nearest_among(const Part& part, std::span<const std::uint32_t> items,
                                    const scene::SurfacePoint& point) const {
  Index found = none;
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t item : items) {
    const Index element = part.first + item;
    const Outline& o = outlines_[static_cast<std::size_t>(element)];
    const Vec3 d = point.position - o.corner;
    const double inside = o.inside(d), height = std::abs(o.normal.dot(d));
    if (!(inside >= 0 && height <= o.thickness)) continue;
    if (inside > o.rim) return element;  // no other one of a surface that does not meet itself
    if (height < least || (height == least && element < found)) least = height, found = element;
  }
  if (found != none) return found;
  const auto nearest = mesh_.locate(point);
  return nearest ? static_cast<Index>(nearest->element.value) : none;
}

Index ElementLocator::operator()(const scene::SurfacePoint& point) const { return by(guess(point), point); }

void ElementLocator::operator()(std::span<const std::optional<scene::SurfacePoint>> points,
                                std::span<Index> elements) const {
  constexpr std::size_t at_once = 64;
  std::array<Guess, at_once> of;
  for (std::size_t first = 0; first < points.size(); first += at_once) {
    const auto some = points.subspan(first, std::min(at_once, points.size() - first));
    for (std::size_t k = 0; k < some.size(); ++k) {
      of[k] = some[k] ? guess(*some[k]) : Guess{};
      if (of[k].items != nullptr) __builtin_prefetch(of[k].items);
    }
    for (std::size_t k = 0; k < some.size(); ++k)
      if (of[k].items != nullptr) of[k].part->outlines.prefetch(of[k].items->front());
    for (std::size_t k = 0; k < some.size(); ++k) elements[first + k] = some[k] ? by(of[k], *some[k]) : none;
  }
}

}  // namespace interflect::fem
