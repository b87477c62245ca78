#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "measure/path_classes.h"
#include "montecarlo/next_event.h"
#include "scene/scene.h"

namespace interflect::montecarlo {

/// Light of which chance alone tells: what small lights send by way of mirrors or smooth glass onto what is none.  No way
/// can be drawn to it, and where no path has met it, samples know nothing of it.  Without next-event estimation all light is
/// of that kind.
///
/// A find is pi L of irradiance.  Where n samples met none, a light may have brought 3 pi L / n (rule of three); a sun no
/// more than H, what its image in a flat mirror gives.  A light counts as met where a path of the scene's size meets it a
/// hundred times in n samples: ten times where it shines at a tenth of that, aslant or by a dark mirror.
/// Test: tests/montecarlo/rare_light.cpp
class RareLights {
 public:
  /// @param paths  that count
  RareLights(const scene::Scene& scene, const measure::PathClasses& paths, NextEvent next_event = NextEvent::yes);
  bool empty() const { return lights_.empty(); }

  /// What so many samples of an irradiance may lack, as a standard error [W/m² | lx].
  /// @param otherwise  chance that a sample finds such light in another way
  Spectrum lacks(std::uint64_t samples, double otherwise = 0) const;
  /// Samples for which that is as little, weighed, as far as samples help.
  double samples_for(double wanted, const scene::Scene& scene, double otherwise = 0) const;
  /// "light of sun by way of mirrors or smooth glass is met by one path in 46223 or so, and 4096 were taken: .."
  std::string text(const scene::Scene& scene, std::uint64_t samples) const;

 private:
  struct RareLight {
    std::string name;
    double chance;         ///< that a path which leaves diffusely at the scene's radius from it meets it
    bool anywhere;         ///< the same everywhere: a sun
    Spectrum pi_radiance;  ///< pi L
    double met_by(double otherwise) const { return std::max(chance, otherwise); }
    double samples_to_meet(double otherwise) const { return 100 / met_by(otherwise); }
    Spectrum find(double otherwise) const { return pi_radiance * (chance / met_by(otherwise)); }
    Spectrum lacks(double samples, double otherwise) const;
  };
  std::vector<RareLight> lights_;
  bool by_mirrors_;
};

}  // namespace interflect::montecarlo
