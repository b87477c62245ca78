#pragma once

#include <span>
#include <string>

#include "measure/method.h"
#include "montecarlo/bsdf/of_material.h"

namespace interflect::montecarlo {

/// The paths that light may take in a scene, by what its lights are and its surfaces do, wherever they stand: of an
/// office `(A)(D)*E`.
measure::PathClasses paths_in(const scene::Scene& scene);

/// What its surfaces do with light, any of them.
Scatters scatters_in(const scene::Scene& scene);

/// Those of them that bring something to what is asked.  Points, spots and parallel light are not seen, in mirrors
/// neither: that is a convention (docs/lights.md), which leaves `(P|B)S*E` out of pixels.
measure::PathClasses that_reach(const measure::Measurement& asked, const measure::PathClasses& paths);

/// @throws core::InputError  if the method misses paths of `wanted` that there may be in the scene, to some of what is
///                           asked: with one of them, and how to leave them out
void require_found(const measure::Method& method, const scene::Scene& scene,
                   std::span<const measure::Measurement> asked, const measure::PathClasses& wanted);

}  // namespace interflect::montecarlo
