#pragma once

#include <cstdint>
#include <string>

#include "core/image.h"
#include "core/run.h"
#include "raycast/ray_caster.h"
#include "scene/scene.h"

namespace interflect::montecarlo {

/// A picture with what is known of its noise.
struct Rendering {
  core::Image radiance;        ///< L per pixel and channel [W/(m² sr) | cd/m²]
  core::Image standard_error;  ///< of the radiance, same unit; infinite where a pixel has a single sample
  std::uint64_t samples = 0;   ///< that every pixel has; more in some, if the run was stopped within a pass
};

/// Path-traced picture: the mean radiance over each pixel's area, `samples` paths a pixel (see PathTracer for the
/// estimator and for the standard error of pixels that saw nothing).
///
/// Sample k of a pixel is keyed by (seed, pixel, k): same bits for any number of threads.  It is rendered in passes
/// that double the samples of every pixel, and a run that is stopped gives the whole picture with the samples so far.
/// @throws core::Interrupted  if it is stopped before every pixel has a sample
/// @throws core::InputError   if there is no such camera, or no samples are asked for
Rendering render(const scene::Scene& scene, scene::CameraId camera, std::uint64_t samples, Run& run,
                 const std::string& intersector = "embree");
/// The same with a ray caster of the scene that is there already.
Rendering render(const scene::Scene& scene, scene::CameraId camera, std::uint64_t samples, Run& run,
                 const raycast::RayCaster& caster);

}  // namespace interflect::montecarlo
