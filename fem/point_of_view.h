#pragma once

#include "scene/camera.h"

namespace interflect::fem {

/// Pixels of finite elements are what single rays see: any camera whose rays through a point of the film are one.
/// @throws core::InputError  for a thin lens: "camera 'a': radiosity knows no thin lens; interflect trace does"
void require_point_of_view(const scene::Camera& camera);

}  // namespace interflect::fem
