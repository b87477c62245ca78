#pragma once

#include <memory>

#include "montecarlo/bsdf/bsdf.h"
#include "scene/material.h"

namespace interflect::montecarlo {

/// How a material scatters on both sides; nothing where it absorbs all that arrives.
std::unique_ptr<Bsdf> bsdf_of(const scene::Material& material);

}  // namespace interflect::montecarlo
