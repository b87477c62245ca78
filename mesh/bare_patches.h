#pragma once

#include <vector>

#include "mesh/element_mesh.h"

namespace interflect::mesh {

/// What is there and has no elements: the facets of surfaces of which a mesh has none, such as mirrors, polished metals,
/// panes and glass in a radiosity solution; of each active side, fronts before backs, in the order of the surfaces.
/// Facets without an area are left out.
std::vector<scene::SurfacePatch> bare_patches(const scene::Scene& scene, const ElementMesh& mesh);

}  // namespace interflect::mesh
