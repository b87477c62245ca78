#pragma once

#include <string>
#include <vector>

#include "mesh/element_mesh.h"
#include "scene/scene.h"
#include "visual/raster.h"

namespace interflect::visual {

/// What stands in a scene and has no elements (mesh/bare_patches.h), as it is drawn: hatched.
struct BareSurfaces {
  std::vector<scene::SurfacePatch> patches;
  Layer opaque;
  std::uint32_t faces = 0;         ///< numbers of the opaque ones are no more than this, one a material (hatching.h)
  std::vector<Polygons> clear;     ///< what is behind them shows: body by body, what hangs together over corners
  std::vector<std::string> kinds;  ///< "mirror", "glass": what there is, each once
};
BareSurfaces bare_surfaces(const scene::Scene& scene, const mesh::ElementMesh& mesh);

/// "hatched: no elements (mirror, glass)".
std::string note_of(const BareSurfaces& bare);

}  // namespace interflect::visual
