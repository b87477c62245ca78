#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/estimate.h"
#include "core/run.h"
#include "measure/measurement.h"
#include "measure/path_classes.h"
#include "scene/scene.h"

namespace interflect::measure {

/// What a method can find and what it promises; only answers that both sides promise are compared.
struct Capabilities {
  bool unbiased = false;    ///< expected value right for any number of samples
  bool consistent = false;  ///< right in the limit of its refinement
  /// The paths that it finds, to what is asked.  Paths from points and spots straight into a pixel, `PS*E`, are nothing
  /// to anyone: such lights are not seen, by convention (docs/lights.md).
  PathClasses to_patches = PathClasses::all();  ///< patches and fluxes
  PathClasses to_points = PathClasses::all();
  PathClasses to_pixels = PathClasses::all();

  const PathClasses& paths_to(const Measurement& asked) const;
};

/// A way to answer measurements: radiosity by finite elements, and every Monte Carlo integrator.
class Method {
 public:
  virtual ~Method() = default;
  virtual std::string name() const = 0;
  virtual Capabilities capabilities() const = 0;
  /// One estimate per measurement, in their order.  The whole list at once: some methods answer all from the same
  /// samples.
  virtual std::vector<Estimate> answer(const scene::Scene& scene, std::span<const Measurement> asked,
                                       Run& run) const = 0;
};

}  // namespace interflect::measure
