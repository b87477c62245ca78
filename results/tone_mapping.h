#pragma once

#include <span>

#include "core/image.h"
#include "scene/scene.h"

namespace interflect::results {

/// From radiance to what a screen shows: divided by `white`, clipped to [0, 1], encoded as sRGB (IEC 61966-2-1).
struct ToneMapping {
  double white = 0;  ///< radiance shown as white; 0: the 99th percentile of the picture
};

/// A picture of any number of channels as linear R, G, B, for looking (Scene::rgb).
core::Image as_rgb(const scene::Scene& scene, const core::Image& radiance);

/// The 99th percentile of the pixels' largest channels; 0 where that is dark.  Pixels that are not finite are
/// left out.
double white_of(const core::Image& image);

/// The value below which `part` (0 .. 1) of the total weight lies: for exposures and legends.  `weights` may be empty:
/// equal ones. Values that are not finite are left out; 0 if none is left.
double weighted_quantile(std::span<const double> values, std::span<const double> weights, double part);

/// Linear [0, 1] to sRGB [0, 1], clipped: 12.92 x below 0.0031308, 1.055 x^(1/2.4) - 0.055 above.
double srgb_encoded(double linear);

/// An image for display, with the same channels.  Three channels are taken as linear red, green, blue.
core::Image tone_mapped(const core::Image& image, const ToneMapping& tone = {});

}  // namespace interflect::results
