#pragma once

#include <filesystem>

#include "core/image.h"
#include "core/run.h"
#include "measure/method.h"
#include "scene/scene.h"

namespace interflect::apps {

/// A picture of any number of channels as linear R, G, B, for looking.
core::Image as_rgb(const scene::Scene& scene, const core::Image& radiance);

/// What a method sees through a camera: one PixelRadiance a pixel [W/(m² sr) | cd/m²].
core::Image picture_of(const measure::Method& method, const scene::Scene& scene, scene::CameraId camera, Run& run);

/// Finite elements, path tracing, and their difference beside each other, the first two at the same exposure; the difference
/// relative to the mean radiance of both, averaged over small blocks of pixels, blue where finite elements are darker, red where brighter, full at `full_scale`.
core::Image comparison_picture(const scene::Scene& scene, const core::Image& fem, const core::Image& traced, double full_scale);

}  // namespace interflect::apps
