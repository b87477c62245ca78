#include "fem/bounds/black_backs.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace interflect::fem {
namespace {

using scene::Side;

/// Of the scene's size, beside the rounding of coordinates: planes as near are one for every shaft, and planes further
/// apart are two.  A shaft's margin is 1e-11 of the diagonal of all parts and that rounding
/// (ElementShapes::plane_tolerance); the diagonal is the scene's size at least, and 4.8 times that at most, with a box
/// around the scene.
constexpr double one_plane = 1e-11, two_planes = 5e-11;

}  // namespace

BlackBacks::Covered BlackBacks::covered(const FacetCell& cell, Side side) const {
  const Vec3 x = middle_of(cell);
  bool yes = false, unknown = false;
  all_.tree.traverse(
      [&](const geometry::Box& box) { return box.squaredExteriorDistance(x) <= all_.tolerance * all_.tolerance; },
      [&](std::uint32_t k) {
        const Covered by = covered_by(all_.cells[k].facet, all_.cells[k].normal, cell, side);
        yes |= by == Covered::yes;
        unknown |= by == Covered::unknown;
      });
  return unknown ? Covered::unknown : yes ? Covered::yes : Covered::no;
}

BlackBacks::Covered BlackBacks::covered_by(std::uint32_t facet, const Vec3& normal, const FacetCell& cell,
                                           Side side) const {
  const std::array<Vec3, 3>& other = all_.facets[facet];
  const auto height = [&](const Vec3& x) { return std::abs(normal.dot(x - other[0])); };
  const Vec3 x = middle_of(cell);
  if (facet == cell.facet || height(x) > all_.tolerance || depth_in(other, normal, x) <= 0 ||
      !are_parallel(normal, cell.normal))
    return Covered::no;
  double nearest = height(x), furthest = nearest;
  for (const Vec3& corner : cell.ring) {
    nearest = std::min(nearest, height(corner));
    furthest = std::max(furthest, height(corner));
  }
  if (nearest > two_planes + 2 * all_.rounding) return Covered::no;
  if (furthest > one_plane + all_.rounding) return Covered::unknown;
  const Side its = (normal.dot(cell.normal) > 0) == (side == Side::front) ? Side::front : Side::back;
  const bool has_elements = scene_.material(scene_.facets[facet].surface).active(its);
  return has_elements || facet < cell.facet ? Covered::yes : Covered::no;
}

void BlackBacks::append(const FacetCell& cell, Side side, std::vector<scene::SurfacePatch>& out) const {
  const double least = all_.tolerance * all_.size;
  for (std::size_t k = 2; k < cell.ring.size(); ++k) {
    std::array<Vec3, 3> ring{cell.ring[0], cell.ring[k - 1], cell.ring[k]};
    if (side == Side::back) std::swap(ring[1], ring[2]);
    for (Vec3& corner : ring) corner = all_.outside(corner);
    const scene::SurfacePatch patch = scene::make_patch(scene_.facets[cell.facet].surface, side, ring);
    if (patch.area > least * least) out.push_back(patch);
  }
}

/// @return  false where it is not known what covers it
bool BlackBacks::append_facet(std::uint32_t f, Side side, std::span<const FacetCell> cells,
                              std::vector<scene::SurfacePatch>& out) const {
  std::vector<const FacetCell*> bare;
  for (const FacetCell& cell : cells) {
    const Covered by = covered(cell, side);
    if (by == Covered::unknown) return false;
    if (by == Covered::no) bare.push_back(&cell);
  }
  if (bare.size() < cells.size()) {
    for (const FacetCell* cell : bare) append(*cell, side, out);
    return true;
  }
  const auto& [a, b, c] = scene_.facets[f].corner;
  const std::array<Vec3, 3> ring = side == Side::front ? std::array{a, b, c} : std::array{a, c, b};
  out.push_back(scene::make_patch(scene_.facets[f].surface, side, ring));
  return true;
}

std::optional<std::vector<scene::SurfacePatch>> BlackBacks::all() const {
  std::vector<scene::SurfacePatch> out;
  std::size_t first = 0;
  for (std::uint32_t f = 0; f < scene_.facets.size(); ++f) {
    std::size_t end = first;
    while (end < all_.cells.size() && all_.cells[end].facet == f) ++end;
    const auto cells = std::span(all_.cells).subspan(first, end - first);
    first = end;
    if (!(scene_.facets[f].area > 0)) continue;
    for (const Side side : {Side::front, Side::back})
      if (!scene_.material(scene_.facets[f].surface).active(side) && !append_facet(f, side, cells, out))
        return std::nullopt;
  }
  return out;
}

}  // namespace interflect::fem
