#pragma once

#include <filesystem>
#include <span>

#include "mesh/element_mesh.h"
#include "scene/scene.h"
#include "visual/picture.h"

namespace interflect::apps {

/// A value an element in false colours, from the scene's first pinhole camera, or from outside where it has none.
void write_element_picture(const visual::Display& display, const std::filesystem::path& file, const scene::Scene& scene,
                           const mesh::ElementMesh& mesh, std::span<const double> values, visual::FalseColour look);

}  // namespace interflect::apps
