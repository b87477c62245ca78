#pragma once

#include "montecarlo/exposure.h"
#include "montecarlo/render.h"

namespace interflect::montecarlo {

/// By path tracing: each pixel's samples by themselves, independent or those of a sequence.  All must outlive it.
std::unique_ptr<Exposure> path_exposure(const scene::Scene& scene, const scene::Camera& camera,
                                        const RenderSettings& settings, const ReconstructionFilter& filter,
                                        const raycast::RayCaster& caster, Run& run);

}  // namespace interflect::montecarlo
