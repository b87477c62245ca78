#include "fem/bounds/cell_view.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>

#include "scene/place.h"

namespace interflect::fem {
namespace {

/// Whether the polynomial is good enough to stay with in all parts of the cell.
bool is_far(const FactorRange& factor) {
  constexpr double nearly = 0.02;
  return factor.smooth && factor.remainder <= nearly * factor.value;
}
/// Whether what is not constant over a part may matter.
bool is_coarse(const FactorRange& factor) {
  constexpr double much = 0.25;
  return factor.across > much * factor.value;
}

geometry::Box wider(const geometry::Box& box) {
  const Vec3 margin = Vec3::Constant(0.5 * box.diagonal().norm());
  return {box.min() - margin, box.max() + margin};
}

/// A wall of a box, seen from within, in quarters.
void add_wall(const geometry::Box& box, int axis, bool high, scene::SurfaceId id,
              std::vector<scene::SurfacePatch>& out) {
  Vec3 corner = box.min(), u = Vec3::Zero(), v = Vec3::Zero();
  u[(axis + 1) % 3] = box.sizes()[(axis + 1) % 3];
  v[(axis + 2) % 3] = box.sizes()[(axis + 2) % 3];
  if (high) {
    corner[axis] = box.max()[axis];
    std::swap(u, v);
  }
  const Vec3 ring[] = {corner, corner + u, corner + u + v, corner + v};
  for (const scene::SurfacePatch& quarter : scene::quarters_of(scene::make_patch(id, scene::Side::front, ring)))
    out.push_back(quarter);
}

std::vector<scene::SurfacePatch> with_box(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                                          const geometry::Box& box) {
  std::vector<scene::SurfacePatch> all(patches.begin(), patches.end());
  const auto beyond = static_cast<std::uint32_t>(std::ssize(scene.surface_ids()));
  for (int axis = 0; axis < 3; ++axis)
    for (const bool high : {false, true})
      add_wall(box, axis, high, scene::SurfaceId{beyond + static_cast<std::uint32_t>(2 * axis + high)}, all);
  return all;
}

constexpr double too_little = 2e-4;         ///< of what is seen, to be looked at in parts
constexpr double smallest_part = 1.0 / 32;  ///< of an element that is looked at in parts

/// Half of the longest diagonal, or side of a triangle.
double size_of(std::span<const Vec3> ring) {
  double square = 0;
  for (std::size_t k = 0; k < ring.size(); ++k)
    for (std::size_t l = 0; l < k; ++l) square = std::max(square, (ring[k] - ring[l]).squaredNorm());
  return 0.5 * std::sqrt(square);
}

geometry::ConvexRing whole_ring(std::span<const Vec3> ring) {
  geometry::ConvexRing out;
  std::copy(ring.begin(), ring.end(), out.corner.begin());
  out.corners = static_cast<int>(ring.size());
  return out;
}

}  // namespace

Surroundings::Surroundings(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches, bool closed)
    : Surroundings(
          scene, wider(scene.box()),
          closed ? std::vector(patches.begin(), patches.end()) : with_box(scene, patches, wider(scene.box()))) {}

Surroundings::Surroundings(const scene::Scene& scene, const geometry::Box& box, std::vector<scene::SurfacePatch> all)
    : box_(box),
      shapes_(all),
      clusters_(clusters_of(all, shapes_)),
      blockers_(scene, shapes_.origin(), shapes_.plane_tolerance()) {}

Cell Surroundings::cell(std::span<const Vec3> ring) const {
  geometry::Ring relative(ring.begin(), ring.end());
  for (Vec3& x : relative) x -= shapes_.origin();
  return cell_of(relative);
}

Cell Surroundings::cell_at(const Vec3& x, const Vec3& normal) const {
  Cell cell;
  cell.normal = normal;
  cell.s = normal.unitOrthogonal();
  cell.t = normal.cross(cell.s);
  cell.centre = x - shapes_.origin();
  cell.radius = 8 * shapes_.plane_tolerance();
  const auto ring = geometry::speck(cell.centre, normal, cell.radius);
  cell.ring = {ring[0], ring[1], ring[2]};
  cell.area = 1.2 * cell.radius * cell.radius;
  cell.second_moments = {};
  return cell;
}

CellView::CellView(const Surroundings& of, const Cell& cell)
    : of_(of), cell_(cell), horizon_{cell.normal, cell.normal.dot(cell.centre)} {
  for (const ElementCluster& cluster : of.clusters_) look(cluster);
}

CellView::CellView(const CellView& wider, const Cell& cell) : of_(wider.of_), cell_(cell), horizon_(wider.horizon_) {
  for (std::size_t k = 0; k < wider.near_.size(); ++k)
    look(wider.near_[k].element, wider.pieces_[k], &wider.pieces_[k].candidates);
}

void CellView::look(const ElementCluster& cluster) {
  const double rounding = of_.shapes_.plane_tolerance();
  const auto below = [&](std::span<const Vec3> ring) {
    return std::none_of(ring.begin(), ring.end(), [&](const Vec3& y) { return horizon_.distance(y) > rounding; });
  };
  std::optional<Candidates> among;
  if (cluster.rectangle) {
    if (below(*cluster.rectangle)) return;
    among = of_.blockers_.candidates(geometry::Shaft(cell_.ring, *cluster.rectangle, rounding));
  }
  for (const Index j : cluster.elements) {
    const ElementShape& shape = of_.shapes_[j];
    if (below(shape.ring())) continue;
    look(j, {shape.corner, static_cast<std::uint8_t>(shape.corners), 0, true, {}}, among ? &*among : nullptr);
  }
}

/// @param by  who takes some of it, or may
CellView::Hidden CellView::hidden(std::span<const Vec3> ring, const Candidates* among, Candidates& by) {
  if (among && among->empty()) return Hidden::none;
  const double rounding = of_.shapes_.plane_tolerance();
  Candidates found;
  of_.blockers_.append_candidates(geometry::Shaft(cell_.ring, ring, rounding), among, found);
  for (const std::uint32_t k : found) {
    if (!shadow_.prepare(of_.blockers_[k], cell_.ring, ring, rounding)) continue;
    if (shadow_.hides_all()) return Hidden::all;
    by.push_back(k);
  }
  return by.empty() ? Hidden::none : Hidden::some;
}

/// Adds a piece of an element, if any of it may be seen; in quarters, where that says more.
void CellView::look(Index element, const Piece& piece, const Candidates* among) {
  const ElementShape& shape = of_.shapes_[element];
  double lowest = shape.plane.distance(cell_.ring[0]), highest = lowest;
  for (const Vec3& x : cell_.ring) {
    lowest = std::min(lowest, shape.plane.distance(x));
    highest = std::max(highest, shape.plane.distance(x));
  }
  if (highest <= 0) return;
  const std::span<const Vec3> all = piece.ring();
  const bool crosses = std::any_of(all.begin(), all.end(), [&](const Vec3& y) { return horizon_.distance(y) < 0; });
  const geometry::ConvexRing above = crosses ? geometry::clip(all, horizon_) : whole_ring(all);
  if (above.corners == 0) return;
  const std::span<const Vec3> ring = above.ring();
  Candidates by;
  const Hidden is_hidden = hidden(ring, among, by);
  if (is_hidden == Hidden::all) return;
  FactorRange factor = factor_range(cell_, ring, shape.plane);
  if (is_hidden == Hidden::some || lowest < 0) factor = between_none_and(factor.most);
  const bool far = is_far(factor);
  const bool can_say_more =
      far ? is_coarse(factor) && piece.whole && QuarterTree::has(QuarterTree::child(piece.node, 0))
          : factor.most > too_little &&
                size_of(piece.ring()) > std::max(1.2 * size_of(cell_.ring), smallest_part * size_of(shape.ring()));
  if (can_say_more) return look_at_quarters(element, piece, by);
  const PartSeen part{element, piece.node, piece.whole && !crosses, factor, above};
  if (far) {
    far_.push_back(part);
    return;
  }
  near_.push_back(part);
  pieces_.push_back({piece.corner, piece.corners, piece.node, piece.whole, std::move(by)});
}

void CellView::look_at_quarters(Index element, const Piece& piece, const Candidates& among) {
  const auto rings = scene::quarters_of(piece.ring());
  for (int k = 0; k < 4; ++k) {
    const int node = QuarterTree::child(piece.node, k);
    const bool has = piece.whole && QuarterTree::has(node);
    look(element, {rings[static_cast<std::size_t>(k)], piece.corners, has ? node : piece.node, has, {}}, &among);
  }
}

void CellView::refine(const std::function<double(const PartSeen&)>& worth, double tolerance, std::size_t cuts) {
  using Entry = std::pair<double, std::size_t>;  // doubt, part
  std::priority_queue<Entry> open;
  double doubt = 0;
  const auto add = [&](std::size_t part) {
    if (pieces_[part].candidates.empty()) return;
    const double of_part = worth(near_[part]) * (near_[part].factor.most - near_[part].factor.least);
    doubt += of_part;
    if (of_part > 0) open.push({of_part, part});
  };
  for (std::size_t part = 0; part < near_.size(); ++part) add(part);
  std::vector<bool> gone;
  for (; cuts > 0 && doubt > tolerance && !open.empty(); --cuts) {
    const auto [of_part, cut] = open.top();
    open.pop();
    doubt -= of_part;
    gone.resize(near_.size(), false);
    gone[cut] = true;
    const Piece piece = std::move(pieces_[cut]);
    const Index element = near_[cut].element;
    const std::size_t before = near_.size();
    look_at_quarters(element, piece, piece.candidates);
    for (std::size_t part = before; part < near_.size(); ++part) add(part);
  }
  gone.resize(near_.size(), false);
  std::size_t kept = 0;
  for (std::size_t part = 0; part < near_.size(); ++part) {
    if (gone[part]) continue;
    if (kept != part) near_[kept] = near_[part], pieces_[kept] = std::move(pieces_[part]);
    ++kept;
  }
  near_.resize(kept);
  pieces_.resize(kept);
}

}  // namespace interflect::fem
