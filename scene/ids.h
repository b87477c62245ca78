#pragma once

#include "core/strong_id.h"

namespace interflect::scene {

using SurfaceId = StrongId<struct SurfaceTag>;
using MaterialId = StrongId<struct MaterialTag>;
using CameraId = StrongId<struct CameraTag>;

}  // namespace interflect::scene
