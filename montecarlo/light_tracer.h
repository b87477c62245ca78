#pragma once

#include <cstdint>
#include <string>

#include "measure/method.h"
#include "raycast/ray_caster.h"

namespace interflect::montecarlo {

struct SampleReport;

struct LightTracerSettings {
  std::uint64_t samples = 0;  ///< paths in all; 0: as many as `target` asks for
  double target = 0.01;       ///< relative standard error of every measurement's weighted value
  double target_floor = 0.1;  ///< ... or relative to this part of the scene's mean irradiance
  std::uint64_t max_samples = std::uint64_t{1} << 28;
  std::string intersector = "embree";
  measure::PathClasses paths = measure::PathClasses::all();  ///< that count
  SampleReport* report = nullptr;  ///< of the samples behind the answers, to be added to; null: none
};

/// Light tracing [Arvo, Kirk 1990; Dutre, Lafortune, Willems 1993]: paths start on lights, in proportion to their flux,
/// and carry flux from surface to surface.  All measurements are answered by the same paths.
///
///   mean irradiance of a patch   phi / A of each hit, before it is known whether the path goes on
///   flux                         phi of each hit
///   irradiance at a point x      at each vertex y   phi f(i -> x) |cos_y| cos_x / r²,   and the light at once
///   radiance of a pixel          at each vertex y   phi f(i -> eye) |cos_y| p_pixel / r²   (FilmMap::image_of)
///
/// phi is the flux that arrives at y, over the number of paths.  Of points, and of pixels, one each is joined to a
/// vertex, drawn evenly, and counts as all of them.  Paths go on with q = min(0.999, phi / phi_0): never cut by length.
///
/// A sample of a measurement is a whole path, with all that it adds to that measurement: paths that add nothing count.
/// Estimates of different measurements share paths: a sum of their variances is not that of their sum, so what is to be
/// known of many together is to be asked as one.  Of fewer than 25 paths that scored, the standard error is three of
/// the largest scores over the number of paths at least (rule of three; of points and pixels, of which no score is the
/// largest, by what light adds at once).  With a target, pilots that are thrown away say how many paths are needed.
/// Finds all paths to patches.  To points and pixels it does not find what mirrors, panes and smooth glass show there
/// (no vertex can be joined through them); it refuses to answer rather than leave them out.
/// Sample k is keyed by (seed, k): same bits for any number of threads.
class LightTracer final : public measure::Method {
 public:
  explicit LightTracer(LightTracerSettings settings = {}) : settings_(std::move(settings)) {}
  std::string name() const override { return "light"; }
  measure::Capabilities capabilities() const override;

  /// When the run is stopped, the estimates have fewer samples.
  /// @throws core::Interrupted  if there are none yet
  /// @throws core::InputError   for what it cannot find, and measurements that cannot be taken
  std::vector<Estimate> answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                               Run& run) const override;

 private:
  LightTracerSettings settings_;
};

}  // namespace interflect::montecarlo
