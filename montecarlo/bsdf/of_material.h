#pragma once

#include <memory>

#include "montecarlo/bsdf/bsdf.h"
#include "scene/material.h"

namespace interflect::montecarlo {

/// How a material scatters on both sides; nothing where it absorbs all that arrives.
std::unique_ptr<Bsdf> bsdf_of(const scene::Material& material);

/// What that does with light (measure::PathLetter), without the tables that a rough one is drawn by: at once.
/// Test: tests/montecarlo/materials.cpp
struct Scatters {
  bool diffuse = false, glossy = false, specular = false;
  friend bool operator==(const Scatters&, const Scatters&) = default;
};
Scatters scatters_of(const scene::Material& material);

}  // namespace interflect::montecarlo
