#pragma once

#include <cstdint>
#include <vector>

#include "mesh/element_mesh.h"
#include "scene/scene.h"

namespace interflect::visual {

/// What an eye takes for one face of a body: elements of one material, on the same side, that hang together over
/// corners which they share, each within 20 degrees of the next.
/// @return  a number per element, 0, 1, .. in the order of the mesh
std::vector<std::uint32_t> faces_of(const scene::Scene& scene, const mesh::ElementMesh& mesh);

}  // namespace interflect::visual
