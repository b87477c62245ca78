#pragma once

#include <memory>
#include <vector>

#include "montecarlo/bsdf/bsdf.h"
#include "scene/scene.h"

namespace interflect::montecarlo {

/// What the surfaces of a scene do with light.
class SurfaceOptics {
 public:
  explicit SurfaceOptics(const scene::Scene& scene);

  /// Of the side where a point lies.
  const Spectrum& exitance(const scene::SurfacePoint& at) const {
    return exitance_[2 * at.surface.value + (at.side == scene::Side::back)];
  }
  /// Null: black.
  const Bsdf* bsdf(scene::SurfaceId surface) const { return bsdf_[surface.value]; }
  /// A surface of which some is a mirror, smooth glass or the like.
  std::optional<scene::SurfaceId> any_mirror() const { return any_mirror_; }
  /// Whether light passes straight through any surface.
  bool any_lets_pass() const { return any_lets_pass_; }

 private:
  std::vector<Spectrum> exitance_;  ///< [2 * surface + (side is back)]
  std::vector<const Bsdf*> bsdf_;
  std::vector<std::unique_ptr<Bsdf>> of_materials_;
  bool any_lets_pass_ = false;
  std::optional<scene::SurfaceId> any_mirror_;
};

/// The normal of the front, whichever side a point lies on.
inline Vec3 front_normal(const scene::SurfacePoint& at) {
  return at.side == scene::Side::front ? at.normal : Vec3(-at.normal);
}

}  // namespace interflect::montecarlo
