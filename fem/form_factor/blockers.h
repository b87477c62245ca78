#pragma once

#include <cstdint>
#include <vector>

#include "geometry/box_tree.h"
#include "geometry/shaft.h"
#include "scene/scene.h"

namespace interflect::fem {

/// The scene's facets, joined to convex polygons and solids, as what may lie in the way.
class Blockers {
 public:
  /// @param origin  that shafts are relative to [m]
  /// @param rounding  of coordinates there [m]
  Blockers(const scene::Scene& scene, const Vec3& origin, double rounding);

  const geometry::ConvexBlocker& operator[](std::uint32_t k) const { return blockers_[k]; }

  /// All that may reach into the shaft.
  std::vector<std::uint32_t> candidates(const geometry::Shaft& shaft) const;
  /// The same, appended; `among`, if there is one, is a list made for a wider shaft.
  void append_candidates(const geometry::Shaft& shaft, const std::vector<std::uint32_t>* among,
                         std::vector<std::uint32_t>& found) const;
  /// False only if none reaches into the shaft, by the whole tree or by a list made for a wider shaft.
  bool any(const geometry::Shaft& shaft) const;
  bool any(const geometry::Shaft& shaft, const std::vector<std::uint32_t>& among) const;

 private:
  std::vector<geometry::ConvexBlocker> blockers_;  ///< relative to the origin
  geometry::BoxTree tree_;
};

}  // namespace interflect::fem
