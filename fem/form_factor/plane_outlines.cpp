#include "fem/form_factor/plane_outlines.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
  spread_cells(patches);
}

void PlaneOutlines::spread_cells(std::span<const scene::SurfacePatch> patches) {
  std::vector<Eigen::AlignedBox2f> boxes;
  Eigen::AlignedBox2f all;
  Eigen::Array2f mean = Eigen::Array2f::Zero();
  for (const scene::SurfacePatch& patch : patches) {
    Eigen::AlignedBox2f& box = boxes.emplace_back();
    for (const Vec3& x : patch.ring()) box.extend(at(x));
    all.extend(box);
    mean += box.sizes().array() / static_cast<float>(patches.size());
  }
  constexpr float along_an_element = 4, most_an_element = 64;
  const float most = most_an_element * static_cast<float>(boxes.size());
  const Eigen::Array2f sizes = all.sizes().array().max(margin_);
  Eigen::Array2f cells = (along_an_element * sizes / mean.max(margin_)).max(1);
  cells *= std::min(1.0F, std::sqrt(most / cells.prod()));
  cells = cells.max(1).min(most).round();
  low_ = all.min(), per_length_ = cells / sizes, last_ = cells - 1;
  across_ = static_cast<std::size_t>(cells.x());
  likely_.assign(across_ * static_cast<std::size_t>(cells.y()), {none, none});
  // What holds the middle comes first, then what holds most of the rest.
  for (const auto& [x, y] :
       {std::pair(.5F, .5F), std::pair(.1F, .1F), std::pair(.9F, .1F), std::pair(.1F, .9F), std::pair(.9F, .9F)})
    take_places(boxes, {x, y});
}

/// Every element takes the place that is free in cells of which it holds a point.
/// @param in_cell  where that point is, of the cell's sides
void PlaneOutlines::take_places(std::span<const Eigen::AlignedBox2f> boxes, const Eigen::Array2f& in_cell) {
  for (std::uint32_t item = 0; item < boxes.size(); ++item) {
    const Eigen::Array2f from = (boxes[item].min() - low_).array() * per_length_,
                         to = ((boxes[item].max() - low_).array() * per_length_).min(last_);
    for (float y = std::floor(from.y()); y <= to.y(); ++y)
      for (float x = std::floor(from.x()); x <= to.x(); ++x) {
        if (!surely_holds(item, low_ + ((Eigen::Array2f(x, y) + in_cell) / per_length_).matrix())) continue;
        Likely& of_cell = likely_[static_cast<std::size_t>(y) * across_ + static_cast<std::size_t>(x)];
        if (of_cell[0] == none)
          of_cell[0] = item;
        else if (of_cell[0] != item && of_cell[1] == none)
          of_cell[1] = item;
      }
  }
}

}  // namespace interflect::fem
