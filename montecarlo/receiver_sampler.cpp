#include "montecarlo/receiver_sampler.h"

#include <algorithm>

#include "montecarlo/warp.h"

namespace interflect::montecarlo {
namespace {

constexpr std::uint32_t place_block = 0, pick_block = 1;

}  // namespace

ReceiverSampler::ReceiverSampler(const measure::Measurement& asked) {
  if (const auto* patch = std::get_if<measure::PatchIrradiance>(&asked)) set_regions({&patch->patch, 1});
  if (const auto* flux = std::get_if<measure::Flux>(&asked)) set_regions(flux->through);
  if (const auto* point = std::get_if<measure::PointIrradiance>(&asked)) point_ = {point->position, point->normal};
}

void ReceiverSampler::set_regions(std::span<const scene::SurfacePatch> patches) {
  std::vector<double> areas;
  for (const scene::SurfacePatch& patch : patches) {
    regions_.push_back({patch, patch.normal(), first_triangle_share(patch)});
    areas.push_back(patch.area);
  }
  pick_ = AliasTable(areas);
  pdf_area_ = 1 / pick_.total();
}

geometry::Box ReceiverSampler::box() const {
  if (regions_.empty()) return geometry::Box(point_.position);
  geometry::Box box;
  for (const Region& region : regions_)
    for (std::size_t k = 0; k < region.patch.corners; ++k) box.extend(region.patch.corner[k]);
  return box;
}

Receiver ReceiverSampler::at(double u, double v) const {
  if (regions_.empty()) return point_;
  double left = u * pick_.total();
  std::size_t region = 0;
  for (; region + 1 < regions_.size() && left >= regions_[region].patch.area; ++region)
    left -= regions_[region].patch.area;
  const auto& [patch, normal, share] = regions_[region];
  return {patch_point(patch, share, std::min(left / patch.area, 1 - 0x1p-53), v), normal};
}

Receiver ReceiverSampler::draw(core::RandomNumbers& numbers) const {
  if (regions_.empty()) return point_;
  std::uint32_t region = 0;
  if (regions_.size() > 1) {
    numbers.jump(pick_block);
    region = pick_.pick(numbers.next());
  }
  numbers.jump(place_block);
  const double u = numbers.next(), v = numbers.next();
  const auto& [patch, normal, share] = regions_[region];
  return {patch_point(patch, share, u, v), normal};
}

}  // namespace interflect::montecarlo
