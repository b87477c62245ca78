#pragma once

#include <cstdint>
#include <vector>

#include "geometry/box_tree.h"
#include "geometry/shaft.h"
#include "scene/scene.h"

namespace interflect::fem {

/// The scene's facets as what may lie in the way.
class Blockers {
 public:
  /// @param origin  that shafts are relative to [m]
  Blockers(const scene::Scene& scene, const Vec3& origin);

  /// All facets that may reach into the shaft.
  std::vector<std::uint32_t> candidates(const geometry::Shaft& shaft) const;
  /// False only if no facet reaches into the shaft, by the whole tree or by a list made for a wider shaft.
  bool any(const geometry::Shaft& shaft) const;
  bool any(const geometry::Shaft& shaft, const std::vector<std::uint32_t>& among) const;

 private:
  std::vector<std::array<Vec3, 3>> facets_;  ///< relative to the origin
  geometry::BoxTree tree_;
};

}  // namespace interflect::fem
