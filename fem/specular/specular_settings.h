#pragma once

#include "fem/radiosity.h"

namespace interflect::fem {

/// Before any work on it.
/// @throws core::InputError  of a surface that radiosity does not know (element_materials.h); beside mirrors and smooth
///                           glass of settings that do not go with them: what follows rays does, which are form factors
///                           by hemisphere-rays and solvers that walk from element to element
void require_solvable(const scene::Scene& scene, const RadiositySettings& settings);

/// The settings; beside mirrors and smooth glass, in place of the default form factors where none were chosen,
/// hemisphere-rays: 8 192 a row unless `samples` or a tolerance of rows says otherwise.
RadiositySettings with_mirrors_seen(const scene::Scene& scene, RadiositySettings settings);

}  // namespace interflect::fem
