#pragma once

#include "core/spectrum.h"
#include "scene/material.h"

namespace interflect::fem {

/// Whether all that a material does is to reflect, or let pass, in one direction each: mirrors, polished metals, smooth
/// glass, panes.
bool is_smooth(const scene::Material& material);

/// What a smooth surface does with what arrives.
struct SmoothParts {
  Spectrum reflected, passed;  ///< parts of the power, together 1 at most
  double eta = 1;              ///< index behind the surface over that before it; 1: what passes goes straight on
};

/// Of a material with `is_smooth`, by the cosine at which light arrives, 0 .. 1, on one of its active sides.
///
/// Panes by core::Pane; boundaries of glass, and metals that have a complex index, by Fresnel; metals that are known by
/// what they reflect at normal incidence, R_0, by R_0 + (1 - R_0) (1 - cos)^5 [Schlick 1994].
/// Test: tests/fem/specular/smooth_surface.cpp
SmoothParts smooth_parts(const scene::Material& material, double cosine, scene::Side side);

}  // namespace interflect::fem
