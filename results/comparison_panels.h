#pragma once

#include "core/image.h"
#include "scene/scene.h"

namespace interflect::results {

/// One view as two methods see it, for display: [0, 1] sRGB, channels R, G, B.
struct ComparisonPanels {
  core::Image fem, traced;  ///< at one exposure, that of the traced picture
  core::Image difference;   ///< (FEM - traced) / mean of both: blue where FEM is darker, red where it is brighter
};

/// @param fem, traced  radiance in the scene's channels, of one size
/// @param full_scale   relative difference at full colour.  It is of the weighted radiance, averaged over blocks of 6 x
/// 6
///                     pixels: a single traced pixel is noise
ComparisonPanels comparison_panels(const scene::Scene& scene, const core::Image& fem, const core::Image& traced,
                                   double full_scale);

}  // namespace interflect::results
