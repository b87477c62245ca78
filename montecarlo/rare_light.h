#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/estimate.h"
#include "measure/path_classes.h"
#include "scene/scene.h"

namespace interflect::montecarlo {

/// Light of which chance alone tells: what a small light sends by way of a mirror or smooth glass onto what is none.  No
/// way can be drawn to it, and where no path has met it, samples know nothing of it.
struct RareLight {
  std::string light;
  double chance;         ///< that a path which leaves diffusely meets it: its image in one flat mirror, at most
  Spectrum pi_radiance;  ///< pi L: the irradiance that such a path finds [W/m² | lx]

  /// Samples that meet it ten times on average, if it is there: in one of 20 000 cases none does.
  double samples_to_meet() const { return 10 / chance; }
  bool is_met_by(std::uint64_t samples) const { return static_cast<double>(samples) >= samples_to_meet(); }
  /// Adds to the standard error of fewer samples what they may lack: by the rule of three, 3 pi L / n, but no more than such
  /// an image gives, chance x pi L.
  /// @param scale  what an irradiance of 1 everywhere would measure
  void widen(const scene::Scene& scene, double scale, Estimate& estimate) const;
  /// "light of sun by way of mirrors or smooth glass is met by one path in 46223 at most, and 4096 were taken: ..."
  std::string text(std::uint64_t samples) const;
};

/// The rarest that there may be among `paths`; nothing where there is none.  From a place at the scene's radius R from it
/// a sun of the half angle alpha is met by sin² alpha of all paths, a ball by (r / R)², a surface by its area over pi R².
/// Test: tests/montecarlo/rare_light.cpp
std::optional<RareLight> rare_light(const scene::Scene& scene, const measure::PathClasses& paths);

}  // namespace interflect::montecarlo
