#include "fem/bounds/lit_regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/hemisphere.h"
#include "fem/bounds/edge_pieces.h"
#include "fem/bounds/line_box.h"
#include "fem/bounds/surface_cycles.h"
#include "raycast/scene_frame.h"

namespace interflect::fem {
namespace {

using scene::Side;

constexpr double same_place = 1e-9;  ///< of the scene's size
constexpr double coordinates = 4;    ///< roundings of coordinates, as near as which counts as the same place too
constexpr double margin = 10;        ///< tolerances that a ray keeps from edges: cells are moved by three at most
constexpr double level_within = 4;   ///< tolerances: what lies in a cell's plane
constexpr double parallel = 1e-5;    ///< rad
constexpr std::array sides{Side::front, Side::back};

Vec3 normal_of(const FacetCell& cell, Side side) { return side == Side::front ? cell.normal : Vec3(-cell.normal); }

Vec3 middle_of(const FacetCell& cell) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& x : cell.ring) sum += x;
  return sum / static_cast<double>(cell.ring.size());
}

/// The least distance of a point of its plane from a convex polygon's edges; negative outside.
double depth_in(const FacetCell& cell, const Vec3& x) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < cell.ring.size(); ++k) {
    const Vec3& corner = cell.ring[k];
    const Vec3 inward = cell.normal.cross(cell.ring[(k + 1) % cell.ring.size()] - corner).normalized();
    least = std::min(least, inward.dot(x - corner));
  }
  return least;
}

/// Directions in front of a surface, none along an axis or nearer to the surface than 0.3 rad; always the same.
std::array<Vec3, 24> directions_about(const Vec3& normal) {
  const core::Frame frame = core::frame_around(normal);
  constexpr double golden = 0.6180339887498949;
  std::array<Vec3, 24> out;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const double turn = golden * static_cast<double>(k + 1);
    const double u = 0.9 * (static_cast<double>(k) + 0.5) / static_cast<double>(out.size());
    out[k] = frame.to_world(core::cosine_hemisphere(u, turn - std::floor(turn)));
  }
  return out;
}

/// What is in one of them, and not in both.
void toggle(std::vector<std::uint32_t>& label, const std::vector<std::uint32_t>& cycles) {
  std::vector<std::uint32_t> out;
  std::set_symmetric_difference(label.begin(), label.end(), cycles.begin(), cycles.end(), std::back_inserter(out));
  label = std::move(out);
}

}  // namespace

LitRegions::LitRegions(const scene::Scene& scene) {
  const raycast::SceneFrame frame = raycast::frame_of(scene);
  centre_ = frame.centre;
  size_ = frame.size;
  tolerance_ = std::max(same_place, coordinates * frame.rounding / frame.size);
  closed_ = find_cells(scene) && find_labels(scene);
  if (closed_) find_black_sides(scene);
}

bool LitRegions::contain(const Vec3& x, const Vec3& normal) const {
  if (!closed_) return false;
  const std::optional<Label> there = label((x - centre_) / size_, normal);
  return there && labels_.contains(*there);
}

/// @return  whether there may be cycles
bool LitRegions::find_cells(const scene::Scene& scene) {
  std::vector<std::array<Vec3, 3>> triangles;
  for (const scene::Facet& facet : scene.facets) {
    std::array<Vec3, 3>& unit = triangles.emplace_back(facet.corner);
    for (Vec3& x : unit) x = (x - centre_) / size_;
  }
  constexpr std::size_t most_a_facet = 64, few = 100'000;
  auto cells = facet_cells(triangles, tolerance_, few + most_a_facet * triangles.size());
  if (!cells) return false;
  cells_ = std::move(*cells);
  cycles_ = surface_cycles(edge_pieces(cells_, tolerance_));
  std::vector<geometry::Box> boxes;
  for (const FacetCell& cell : cells_) boxes.push_back(geometry::box_of(cell.ring));
  tree_ = geometry::BoxTree(boxes);
  return true;
}

/// @return  whether what is in front of all elements is enclosed
bool LitRegions::find_labels(const scene::Scene& scene) {
  for (const FacetCell& cell : cells_)
    for (const Side side : sides) {
      if (!scene.material(scene.facets[cell.facet].surface).active(side)) continue;
      std::optional<Label> in_front = label_of(cell, side);
      if (!in_front || in_front->empty()) return false;
      labels_.insert(std::move(*in_front));
    }
  return true;
}

void LitRegions::find_black_sides(const scene::Scene& scene) {
  for (const FacetCell& cell : cells_)
    for (const Side side : sides) {
      if (scene.material(scene.facets[cell.facet].surface).active(side)) continue;
      const std::optional<Label> in_front = label_of(cell, side);
      if (in_front && !labels_.contains(*in_front)) continue;
      add_black(cell, side, scene);
    }
}

/// Cells that overlap have the same outline.
void LitRegions::add_black(const FacetCell& cell, Side side, const scene::Scene& scene) {
  const Vec3 x = middle_of(cell);
  bool taken = false;
  tree_.traverse([&](const geometry::Box& box) { return box.squaredExteriorDistance(x) <= tolerance_ * tolerance_; },
                 [&](std::uint32_t k) { taken |= takes_the_place(cells_[k], cell, side, scene); });
  if (taken) return;
  for (std::size_t k = 2; k < cell.ring.size(); ++k) {
    std::array<Vec3, 3> ring{cell.ring[0], cell.ring[k - 1], cell.ring[k]};
    if (side == Side::back) std::swap(ring[1], ring[2]);
    for (Vec3& corner : ring) corner = centre_ + size_ * corner;
    const scene::SurfacePatch patch = scene::make_patch(scene.facets[cell.facet].surface, side, ring);
    if (patch.area > tolerance_ * tolerance_ * size_ * size_) black_.push_back(patch);
  }
}

/// Whether another cell lies where a black one does, and is seen in its place: an active one, or the first of black
/// ones.
bool LitRegions::takes_the_place(const FacetCell& other, const FacetCell& of, Side side,
                                 const scene::Scene& scene) const {
  const Vec3 x = middle_of(of);
  if (&other == &of || std::abs(other.normal.dot(x - other.ring[0])) > tolerance_ || depth_in(other, x) <= 0 ||
      other.normal.cross(of.normal).norm() > parallel)
    return false;
  const bool same_way = other.normal.dot(of.normal) > 0;
  const Side its = same_way == (side == Side::front) ? Side::front : Side::back;
  return scene.material(scene.facets[other.facet].surface).active(its) || &other < &of;
}

std::optional<LitRegions::Label> LitRegions::label_of(const FacetCell& cell, Side side) const {
  return label(middle_of(cell), normal_of(cell, side));
}

std::optional<LitRegions::Label> LitRegions::label(const Vec3& x, const Vec3& normal) const {
  for (const Vec3& direction : directions_about(normal))
    if (std::optional<Label> found = label_along(x, normal, direction)) return found;
  return std::nullopt;
}

std::optional<LitRegions::Label> LitRegions::label_along(const Vec3& x, const Vec3& normal,
                                                         const Vec3& direction) const {
  constexpr double anywhere = std::numeric_limits<double>::infinity();
  const double near = margin * tolerance_;
  Label label;
  bool clear = true;
  tree_.traverse(
      [&](const geometry::Box& box) { return clear && passes_box(x, direction, -near, anywhere, box, near); },
      [&](std::uint32_t k) {
        if (!clear || cycles_[k].empty()) return;
        const Meeting what = meeting(cells_[k], x, normal, direction);
        clear = what != Meeting::unclear;
        if (what == Meeting::crossing) toggle(label, cycles_[k]);
      });
  return clear ? std::optional(std::move(label)) : std::nullopt;
}

LitRegions::Meeting LitRegions::meeting(const FacetCell& cell, const Vec3& x, const Vec3& normal,
                                        const Vec3& direction) const {
  const double height = cell.normal.dot(cell.ring[0] - x), slope = cell.normal.dot(direction),
               near = margin * tolerance_;
  const bool level = cell.normal.cross(normal).norm() <= parallel;
  if (level && std::abs(height) <= level_within * tolerance_) return Meeting::none;
  constexpr double grazing = 1e-6;
  if (std::abs(slope) <= grazing) return Meeting::unclear;
  const double t = height / slope, depth = depth_in(cell, x + t * direction) * std::abs(slope);
  if (depth < -near || t < -near) return Meeting::none;
  return depth > near && t > near ? Meeting::crossing : Meeting::unclear;
}

}  // namespace interflect::fem
