#pragma once

#include <optional>
#include <vector>

#include "core/vec.h"
#include "raycast/ray_caster.h"

namespace interflect::montecarlo {

/// The balls of a scene (scene::SphereLight), which rays meet beside the facets that a ray caster knows.  One after the
/// other: there are few.
class Balls {
 public:
  struct Hit {
    std::uint32_t ball;
    double distance;  ///< [m]
    Vec3 position;
    Vec3 normal;  ///< unit, outwards
  };

  void add(const Vec3& centre, double radius) { balls_.push_back({centre, radius}); }
  bool empty() const { return balls_.empty(); }

  static constexpr std::uint32_t none = ~0u;
  /// The first ball met, from outside or within, before `within` [m].
  /// @param except  the one that the ray leaves, outwards: it is not met again, whatever rounding says
  std::optional<Hit> closest(const Vec3& origin, const Vec3& direction, double within,
                             std::uint32_t except = none) const;
  /// Whether any but `except` stands between the ends, or holds one.
  bool block(const Vec3& from, const Vec3& to, std::uint32_t except = none) const;

 private:
  struct Ball {
    Vec3 centre;
    double radius;
  };
  std::vector<Ball> balls_;
};

}  // namespace interflect::montecarlo
