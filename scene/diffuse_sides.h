#pragma once

#include "scene/material.h"

namespace interflect::scene {

/// Whether that side reflects diffusely, and nothing else: what finite elements are made of.
inline bool is_diffuse_side(const Material& material, Side side) {
  return material.active(side) && material.is_diffuse();
}

}  // namespace interflect::scene
