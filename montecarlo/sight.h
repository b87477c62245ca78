#pragma once

#include <span>
#include <vector>

#include "montecarlo/light/light_set.h"
#include "montecarlo/surface_optics.h"
#include "raycast/ray_caster.h"

namespace interflect::montecarlo {

/// What rays meet in a scene, and what of light comes from one place to another: surfaces, and balls that shine, which
/// nothing passes.
class Sight {
 public:
  /// All must outlive it.
  Sight(const raycast::RayCaster& caster, const LightSet& lights, const SurfaceOptics& optics)
      : caster_(caster), lights_(lights), optics_(optics) {}
  Sight(const Sight&) = delete;  // who has it has what it looks at, and would leave that behind
  Sight& operator=(const Sight&) = delete;

  /// What a ray meets first: a surface, a ball that shines, or neither.
  struct Met {
    std::optional<scene::SurfacePoint> surface;
    std::optional<Balls::Hit> ball;
  };
  /// @param leaves  the light that the ray starts on, if it is one
  Met met(const raycast::Ray& ray, std::optional<std::uint32_t> leaves = {}) const;

  /// What of light passes between two places: all, nothing, or what panes and nets between them let straight through.
  /// @param of  the light at the segment's end, if it is one
  Spectrum let_pass(const raycast::Segment& segment, std::optional<std::uint32_t> of = {}) const;
  /// The ball that a ray meets before a surface, if any.
  std::optional<Balls::Hit> ball_before(const raycast::Ray& ray, const std::optional<scene::SurfacePoint>& surface,
                                        std::uint32_t leaves = Balls::none) const;
  /// Whether what stands between places can but block all: then that is the ray caster's to say, of many at once.
  bool only_blocks() const { return lights_.balls().empty() && !optics_.any_lets_pass(); }
  const raycast::RayCaster& caster() const { return caster_; }

 private:
  const raycast::RayCaster& caster_;
  const LightSet& lights_;
  const SurfaceOptics& optics_;
};

}  // namespace interflect::montecarlo
