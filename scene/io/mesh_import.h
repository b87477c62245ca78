#pragma once

#include <string>
#include <vector>

#include "geometry/triangulate.h"
#include "scene/builder.h"
#include "scene/io/mesh_reader.h"
#include "scene/io/placement.h"

namespace interflect::scene::io {

/// What may be repaired in a mesh; each repair is counted and noted in the scene.
struct MeshRepair {
  double weld = 0;              ///< vertices nearer than this become one [m]; 0: none
  bool drop_degenerate = true;  ///< faces without area; otherwise they are an error
  bool drop_duplicate =
      true;  ///< faces with the corners of an earlier one, which run the same way or bear the same two-sided material
};

/// Moves the vertices to their place and welds them.  Returns how many were welded to another.
std::size_t place_vertices(MeshFile& mesh, const Placement& placement, double weld);

/// Puts a mesh (its vertices placed) into the scene: a surface for every pair of group and material.
/// @param materials  by the mesh's own material
/// @param shown      the file in notes and messages
void import_mesh(SceneBuilder& builder, const MeshFile& mesh, const std::vector<MaterialId>& materials,
                 const MeshRepair& repair, const std::string& shown);

}  // namespace interflect::scene::io
