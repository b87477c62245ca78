#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/image.h"
#include "core/run.h"
#include "measure/path_classes.h"
#include "measure/surface_solution.h"
#include "montecarlo/film/film_state.h"
#include "montecarlo/sample_report.h"
#include "raycast/ray_caster.h"
#include "scene/scene.h"

namespace interflect::montecarlo {

/// A picture with what is known of its noise.
struct Rendering {
  core::Image radiance;        ///< L per pixel and channel [W/(m² sr) | cd/m²]
  core::Image standard_error;  ///< of the radiance, same unit, and 1/1.96 of a bound on the rest of the error, where an
                               ///< integrator has one; infinite where a pixel has a single sample, or one not finite
  core::Image samples_a_pixel;  ///< one channel, "samples"
  std::uint64_t samples = 0;    ///< that every pixel has; more in some, if the run was stopped within a pass
  SampleReport report = {};     ///< of measurement y * width + x each
  /// Standard errors (with what they hold of bounds) over the radiance, both weighed, or over a tenth of the mean where
  /// that is more: root mean square and mean over the pixels whose samples found light.  Infinite where any error is.
  double relative_error = 0;
  double dark = 0;          ///< share of pixels whose samples found none: their errors are limits of what may be there
  bool met_target = false;  ///< there was one, relative_error is no more, and no light is told of that may be lacked
  bool complete = false;    ///< no stop came before it had all samples, or met its target
};

struct RenderSettings {
  std::uint64_t samples = 64;  ///< a pixel; but for independent ones, and of whitted, a multiple of `sequence_batches`
  std::string filter = "box";
  std::string sequence = "independent";
  measure::PathClasses paths = measure::PathClasses::all();  ///< that count
  std::string integrator = "path";                           ///< see known_integrators
  /// Above 0: of Rendering::relative_error; it ends earlier where that is met.
  double target = 0;
  measure::SurfaceSolution solution = {};  ///< of integrators that need one

  bool independent() const { return sequence == "independent"; }
};

/// Samples of a sequence that is not independent come in so many randomisations of it, each in all pixels by itself:
/// they say how large errors are.
inline constexpr int sequence_batches = 16;

/// How a rendering survives the end of its program.
struct RenderCheckpoints {
  const FilmState* from = nullptr;  ///< the state to go on from; null: from the beginning
  double seconds_between = 60;
  /// Called with the state after so long, at a stop, and where all samples did not meet the target; empty: nothing is
  /// kept.
  std::function<void(const FilmState& state)> keep = {};
  bool at_end = false;  ///< it is kept of a picture too that has all that was asked for, so that it may grow further
};
/// Rows and columns of the state of a picture.
std::pair<Index, Index> render_state_size(const scene::Scene& scene, scene::CameraId camera,
                                          const RenderSettings& settings);

/// Picture by an integrator: the mean radiance over each pixel's area on the film (scene::Camera), or what the filter
/// makes of the film, `samples` paths a pixel (see PathTracer for the estimator and for the standard error of pixels that
/// saw nothing).  What no ray sees, outside of a fisheye's disk, is exactly 0.
///
/// Sample k of a pixel is keyed by (seed, pixel, k): same bits for any number of threads, and for a run that goes on
/// from where another was stopped, with more samples too.  It is rendered in passes over all pixels, and a run that is
/// stopped gives the whole picture with the samples so far.
///
/// Pictures by bidirectional path tracing and by light tracing come in sweeps over all pixels, which share walks from
/// lights (SweepExposure); whitted's in sixteen copies of a quadrature (whitted_exposure).
///
/// Of a sequence the first numbers of a path are its points', those of the film, the lens and the first vertex, each
/// pixel's by randomisations of its own.
/// @throws core::Interrupted  if it is stopped before every pixel has a sample, after its state was kept
/// @throws core::InputError   if there is no such camera, or no samples are asked for, or a filter or sequence that is
///                            not known, or for paths that it misses, or for a state that is none of this picture or
///                            has more samples
Rendering render(const scene::Scene& scene, scene::CameraId camera, const RenderSettings& settings, Run& run,
                 const raycast::RayCaster& caster, const RenderCheckpoints& checkpoints = {});

/// Means over pixels, of independent samples.
Rendering render(const scene::Scene& scene, scene::CameraId camera, std::uint64_t samples, Run& run,
                 const std::string& intersector = "embree");
/// The same with a ray caster of the scene that is there already.
Rendering render(const scene::Scene& scene, scene::CameraId camera, std::uint64_t samples, Run& run,
                 const raycast::RayCaster& caster);

}  // namespace interflect::montecarlo
