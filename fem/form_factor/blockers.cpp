#include "fem/form_factor/blockers.h"

#include <algorithm>

namespace interflect::fem {

Blockers::Blockers(const scene::Scene& scene, const Vec3& origin) {
  std::vector<geometry::Box> boxes;
  for (const scene::Facet& facet : scene.facets) {
    facets_.push_back({facet.corner[0] - origin, facet.corner[1] - origin, facet.corner[2] - origin});
    boxes.push_back(geometry::box_of(facets_.back()));
  }
  tree_ = geometry::BoxTree(boxes);
}

std::vector<std::uint32_t> Blockers::candidates(const geometry::Shaft& shaft) const {
  std::vector<std::uint32_t> found;
  tree_.traverse([&](const geometry::Box& box) { return shaft.may_block(box); },
                 [&](std::uint32_t facet) {
                   if (shaft.may_block(facets_[facet])) found.push_back(facet);
                 });
  return found;
}

bool Blockers::any(const geometry::Shaft& shaft) const {
  bool found = false;
  tree_.traverse([&](const geometry::Box& box) { return !found && shaft.may_block(box); },
                 [&](std::uint32_t facet) { found = found || shaft.may_block(facets_[facet]); });
  return found;
}

bool Blockers::any(const geometry::Shaft& shaft, const std::vector<std::uint32_t>& among) const {
  return std::any_of(among.begin(), among.end(), [&](std::uint32_t facet) { return shaft.may_block(facets_[facet]); });
}

}  // namespace interflect::fem
