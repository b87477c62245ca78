#pragma once

#include "montecarlo/exposure.h"
#include "montecarlo/render.h"

namespace interflect::montecarlo {

/// By bidirectional path tracing, sweep by sweep (BidirectionalFilm): all pixels have as many samples.  All must outlive
/// it.
std::unique_ptr<Exposure> sweep_exposure(const scene::Scene& scene, const scene::Camera& camera,
                                         const RenderSettings& settings, const ReconstructionFilter& filter,
                                         const raycast::RayCaster& caster, Run& run);

}  // namespace interflect::montecarlo
