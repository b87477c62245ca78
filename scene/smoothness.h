#pragma once

#include <cmath>

#include "scene/material.h"

/// What counts as smooth, and as not there at all, whoever follows light: all have to leave the same to each other.
namespace interflect::scene {

/// A roughness below it cannot be told from none.
inline constexpr double least_roughness = 1e-3;

/// Glass in which light neither turns nor is reflected, however rough it is.
inline bool is_unseen(const Glass& glass) { return std::abs(glass.index - 1) < 1e-6; }

inline bool is_smooth(double roughness) { return roughness < least_roughness; }

}  // namespace interflect::scene
