#pragma once

#include <array>
#include <utility>
#include <vector>

#include "core/hemisphere.h"
#include "core/random.h"
#include "montecarlo/light/emission_picker.h"
#include "montecarlo/measured_patches.h"
#include "montecarlo/path_letters.h"
#include "montecarlo/sight.h"
#include "montecarlo/splat_targets.h"

namespace interflect::montecarlo {

/// What one path adds, measurement by measurement.
class Deposits {
 public:
  void clear() { of_.clear(); }
  void add(std::uint32_t measurement, const Spectrum& value) {
    if (value.is_zero()) return;  // what is hidden is no find
    for (auto& [m, sum] : of_)
      if (m == measurement) {
        sum += value;
        return;
      }
    of_.emplace_back(measurement, value);
  }
  std::span<const std::pair<std::uint32_t, Spectrum>> of() const { return of_; }

 private:
  std::vector<std::pair<std::uint32_t, Spectrum>> of_;
};

/// Paths from the lights of a scene.
class LightPaths {
 public:
  LightPaths(const scene::Scene& scene, std::span<const measure::Measurement> asked, const raycast::RayCaster& caster,
             const measure::PathClasses& paths)
      : paths_(paths),
        lights_(scene),
        optics_(scene),
        sight_(caster, lights_, optics_),
        patches_(asked),
        targets_(scene, asked),
        emissions_(lights_) {}
  /// Of a picture: its measurements are those of the targets.
  LightPaths(const scene::Scene& scene, SplatTargets targets, const raycast::RayCaster& caster,
             const measure::PathClasses& paths)
      : paths_(paths),
        lights_(scene),
        optics_(scene),
        sight_(caster, lights_, optics_),
        patches_({}),
        targets_(std::move(targets)),
        emissions_(lights_) {}

  bool dark() const { return emissions_.empty(); }
  const LightSet& lights() const { return lights_; }
  const SplatTargets& targets() const { return targets_; }

  void trace(core::RandomNumbers& numbers, Deposits& deposits) const;

 private:
  using Letters = measure::PathClasses::FromLight;
  /// A path that ends so.
  bool counts(Letters walk) const {
    return measure::PathClasses::joined(paths_.after(walk, measure::PathLetter::eye), paths_.before_eye());
  }
  bool counts_straight_from(std::uint32_t light) const {
    return counts(paths_.after(paths_.before_light(), letter_of(lights_[light])));
  }

  /// Light that has not met a surface yet.
  void join_emission(std::uint32_t light, const Emission& emission, double probability, core::RandomNumbers& numbers,
                     Deposits& deposits) const;
  /// What a path brings to a surface.
  struct Arrived {
    const scene::SurfacePoint& at;
    const core::Frame& frame;
    const Vec3& from;  ///< towards where it came from, in the frame
    const Spectrum& flux;
    Letters letters;  ///< before this surface
  };
  /// Joins a surface that scatters with points and films.
  void join_scattering(const Arrived& arrived, const Bsdf& bsdf, core::RandomNumbers& numbers,
                       Deposits& deposits) const;
  /// @param sends  the intensity towards a direction, per flux that is carried [1/sr]
  template <class Sends>
  void join(const Vec3& y, const Vec3& normal, std::optional<std::uint32_t> light, const Sends& sends, bool points,
            const std::array<double, 4>& u, Deposits& deposits) const;

  const measure::PathClasses& paths_;
  LightSet lights_;
  SurfaceOptics optics_;
  Sight sight_;
  MeasuredPatches patches_;
  SplatTargets targets_;
  EmissionPicker emissions_;
};

}  // namespace interflect::montecarlo
