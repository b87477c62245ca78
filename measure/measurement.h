#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scene/ids.h"
#include "scene/place.h"

/// What is asked of a scene, whoever answers (Veach's measurement equation: I_j = <W_j, L>).
namespace interflect::measure {

/// Mean irradiance H over a patch [W/m² | lx].  B = E + rho H is derived, so that emitters do not hide errors.
struct PatchIrradiance {
  scene::SurfacePatch patch;
};

/// Irradiance at a point for the hemisphere of `normal` [W/m² | lx].  The point has no body: it blocks nothing.
struct PointIrradiance {
  Vec3 position, normal;
  std::optional<scene::SurfaceId> on;  ///< the point lies on this surface, to rounding: its own plane is ignored
};

/// Flux that arrives on patches [W | lm].
struct Flux {
  std::vector<scene::SurfacePatch> through;
};

/// Mean radiance L over a pixel's area on the image plane [W/(m² sr) | cd/m²].
struct PixelRadiance {
  scene::CameraId camera;
  int x, y;
};

using Measurement = std::variant<PatchIrradiance, PointIrradiance, Flux, PixelRadiance>;

}  // namespace interflect::measure
