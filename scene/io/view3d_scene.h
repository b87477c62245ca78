#pragma once

#include <string>
#include <vector>

#include "scene/builder.h"
#include "scene/geometry_file.h"
#include "scene/io/view3d_reader.h"

namespace interflect::scene::io {

/// Puts the surfaces of a View3D file, placed, into the scene and what belongs to it: bases lose the parts that others
/// cover.
/// @param out    its surfaces and masks; its scene is the builder's
/// @param shown  the file in messages
void import_view3d(SceneBuilder& builder, ExchangeScene& out, const std::vector<View3dSurface>& surfaces, Sides sides,
                   const std::string& shown);

}  // namespace interflect::scene::io
