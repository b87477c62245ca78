#include "fem/bounds/lit_regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/hemisphere.h"
#include "fem/bounds/black_backs.h"
#include "fem/bounds/edge_pieces.h"
#include "fem/bounds/line_box.h"
#include "fem/bounds/surface_cycles.h"

namespace interflect::fem {
namespace {

using scene::Side;

constexpr double margin = 10;       ///< tolerances that a ray keeps from edges: cells are moved by three at most
constexpr double level_within = 4;  ///< tolerances: what lies in a cell's plane
constexpr std::array sides{Side::front, Side::back};

Vec3 normal_of(const FacetCell& cell, Side side) { return side == Side::front ? cell.normal : Vec3(-cell.normal); }

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

LitRegions::LitRegions(const scene::Scene& scene) : all_(scene_cells(scene)) {
  if (!all_) return;
  cycles_ = surface_cycles(edge_pieces(all_->cells, all_->tolerance));
  closed_ = find_labels(scene) && find_black_sides(scene);
  if (!closed_) black_.clear();
}

std::optional<std::vector<scene::SurfacePatch>> LitRegions::black_ones(const scene::Scene& scene) const {
  if (closed_) return black_;
  return all_ ? BlackBacks(scene, *all_).all() : std::nullopt;
}

bool LitRegions::contain(const Vec3& x, const Vec3& normal) const {
  if (!closed_) return false;
  const std::optional<Label> there = label(all_->inside(x), normal);
  return there && labels_.contains(*there);
}

/// @return  whether what is in front of all elements is enclosed
bool LitRegions::find_labels(const scene::Scene& scene) {
  for (const FacetCell& cell : all_->cells)
    for (const Side side : sides) {
      if (!scene.material(scene.facets[cell.facet].surface).active(side)) continue;
      std::optional<Label> in_front = label_of(cell, side);
      if (!in_front || in_front->empty()) return false;
      labels_.insert(std::move(*in_front));
    }
  return true;
}

/// @return  whether it is known what covers them
bool LitRegions::find_black_sides(const scene::Scene& scene) {
  const BlackBacks backs(scene, *all_);
  for (const FacetCell& cell : all_->cells)
    for (const Side side : sides) {
      if (scene.material(scene.facets[cell.facet].surface).active(side)) continue;
      const std::optional<Label> in_front = label_of(cell, side);
      if (in_front && !labels_.contains(*in_front)) continue;
      const BlackBacks::Covered covered = backs.covered(cell, side);
      if (covered == BlackBacks::Covered::no) backs.append(cell, side, black_);
      if (covered == BlackBacks::Covered::unknown) return false;
    }
  return true;
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
  const double near = margin * all_->tolerance;
  Label label;
  bool clear = true;
  all_->tree.traverse(
      [&](const geometry::Box& box) { return clear && passes_box(x, direction, -near, anywhere, box, near); },
      [&](std::uint32_t k) {
        if (!clear || cycles_[k].empty()) return;
        const Meeting what = meeting(all_->cells[k], x, normal, direction);
        clear = what != Meeting::unclear;
        if (what == Meeting::crossing) toggle(label, cycles_[k]);
      });
  return clear ? std::optional(std::move(label)) : std::nullopt;
}

LitRegions::Meeting LitRegions::meeting(const FacetCell& cell, const Vec3& x, const Vec3& normal,
                                        const Vec3& direction) const {
  const double height = cell.normal.dot(cell.ring[0] - x), slope = cell.normal.dot(direction),
               near = margin * all_->tolerance;
  if (are_parallel(cell.normal, normal) && std::abs(height) <= level_within * all_->tolerance) return Meeting::none;
  constexpr double grazing = 1e-6;
  if (std::abs(slope) <= grazing) return Meeting::unclear;
  const double t = height / slope, depth = depth_in(cell.ring, cell.normal, x + t * direction) * std::abs(slope);
  if (depth < -near || t < -near) return Meeting::none;
  return depth > near && t > near ? Meeting::crossing : Meeting::unclear;
}

}  // namespace interflect::fem
