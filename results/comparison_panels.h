#pragma once

#include <cstddef>

#include "core/image.h"
#include "scene/scene.h"

namespace interflect::results {

/// How many blocks of a difference are beyond three standard errors, and whether stated errors explain that.
///
/// A normal error is that to one side in one block of 740, and as errors are themselves estimated, of few and skewed
/// samples, twice as often is allowed for.  To either side there are more than `by_chance` then with a probability of
/// .5 %, where each block errs by itself.  More say that the stated errors do not know all: methods differ, or light
/// that is met rarely has not been met by the samples that errors are made of.
struct BlocksApart {
  static constexpr int side = 6;         ///< pixels
  std::size_t blocks = 0;                ///< that have light, and an error that is known
  std::size_t brighter = 0, darker = 0;  ///< brighter: the first picture is

  std::size_t by_chance() const;
  bool is_explained() const { return brighter <= by_chance() && darker <= by_chance(); }
};

/// One view as two methods see it, for display: [0, 1] sRGB, channels R, G, B.
struct ComparisonPanels {
  core::Image fem, traced;  ///< at one exposure, the longer of the two
  /// (FEM - traced) / mean of both: blue where FEM is darker, red where it is brighter, white where noise may be all
  core::Image difference;
  BlocksApart apart = {};  ///< those of the difference that are not white
};

/// @param fem, traced  radiance in the scene's channels, of one size
/// @param noise        standard error of `traced`, pixels independent; not finite where unknown, which counts as noise
/// alone
/// @param full_scale   relative difference at full colour.  It is of the weighted radiance, averaged over blocks of 6 x
///                     6 pixels, for a single traced pixel is noise; what is below three standard errors of the block's
///                     mean stays white
/// @param shared_error standard errors that a block's pixels may have in common, as those of a quadrature: their mean over
///                     a block is as large as they are.  Null: there are none
ComparisonPanels comparison_panels(const scene::Scene& scene, const core::Image& fem, const core::Image& traced,
                                   const core::Image& noise, double full_scale,
                                   const core::Image* shared_error = nullptr);

}  // namespace interflect::results
