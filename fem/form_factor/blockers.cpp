#include "fem/form_factor/blockers.h"

#include <algorithm>

namespace interflect::fem {

Blockers::Blockers(const scene::Scene& scene, const Vec3& origin, double rounding) {
  std::vector<geometry::BlockingTriangle> triangles;
  for (const scene::Facet& facet : scene.facets)
    triangles.push_back({{facet.corner[0] - origin, facet.corner[1] - origin, facet.corner[2] - origin},
                         !scene.material(facet.surface).active(scene::Side::back)});
  blockers_ = geometry::convex_blockers(triangles, rounding);
  std::vector<geometry::Box> boxes;
  for (const geometry::ConvexBlocker& blocker : blockers_) boxes.push_back(geometry::box_of(blocker.corners()));
  tree_ = geometry::BoxTree(boxes);
}

std::vector<std::uint32_t> Blockers::candidates(const geometry::Shaft& shaft) const {
  std::vector<std::uint32_t> found;
  append_candidates(shaft, nullptr, found);
  return found;
}

void Blockers::append_candidates(const geometry::Shaft& shaft, const std::vector<std::uint32_t>* among,
                                 std::vector<std::uint32_t>& found) const {
  if (among) {
    for (const std::uint32_t k : *among)
      if (shaft.may_block(blockers_[k])) found.push_back(k);
    return;
  }
  tree_.traverse([&](const geometry::Box& box) { return shaft.may_block(box); },
                 [&](std::uint32_t k) {
                   if (shaft.may_block(blockers_[k])) found.push_back(k);
                 });
}

bool Blockers::any(const geometry::Shaft& shaft) const {
  bool found = false;
  tree_.traverse([&](const geometry::Box& box) { return !found && shaft.may_block(box); },
                 [&](std::uint32_t k) { found = found || shaft.may_block(blockers_[k]); });
  return found;
}

bool Blockers::any(const geometry::Shaft& shaft, const std::vector<std::uint32_t>& among) const {
  return std::any_of(among.begin(), among.end(), [&](std::uint32_t k) { return shaft.may_block(blockers_[k]); });
}

}  // namespace interflect::fem
