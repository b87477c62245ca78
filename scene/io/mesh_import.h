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
  /// Faces with the corners of an earlier one, which run the same way or bear the same two-sided material.
  bool drop_duplicate = true;
};

/// Moves the vertices to their place.
void place_vertices(MeshFile& mesh, const Placement& placement);

/// Of vertices in their place: 1e-15 of the largest coordinate [m].  A weld below it is lost in their rounding.
double finest_weld(const MeshFile& mesh);

/// Makes one of vertices nearer than `weld` [m], 0 or at least finest_weld.  Returns how many were welded to another.
std::size_t weld_vertices(MeshFile& mesh, double weld);

/// Puts a mesh (its vertices placed) into the scene: a surface for every pair of group and material.
/// @param materials  by the mesh's own material
/// @param shown      the file in notes and messages
void import_mesh(SceneBuilder& builder, const MeshFile& mesh, const std::vector<MaterialId>& materials,
                 const MeshRepair& repair, const std::string& shown);

}  // namespace interflect::scene::io
