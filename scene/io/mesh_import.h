#pragma once

#include <string>
#include <vector>

#include "geometry/triangulate.h"
#include "scene/builder.h"
#include "scene/io/mesh_reader.h"
#include "scene/io/placement.h"

namespace interflect::scene::io {

/// What may be repaired in a mesh; each repair is counted and noted in the scene, with the names of the first few
/// faces.
struct MeshRepair {
  double weld = 0;              ///< vertices nearer than this become one [m]; 0: none
  bool drop_degenerate = true;  ///< faces without area; otherwise they are an error
  /// Faces with the corners of an earlier one, which run the same way or bear the same two-sided material.
  bool drop_duplicate = true;
};

/// Moves the vertices to their place.
/// @throws core::InputError  where that is out of reach
void place_vertices(MeshFile& mesh, const Placement& placement, const std::string& shown);

/// Of vertices in their place: 1e-15 of the largest coordinate [m].  A weld below it is lost in their rounding.
double finest_weld(const MeshFile& mesh);

/// Makes one of vertices nearer than `weld` [m], 0 or at least finest_weld.  Returns how many were welded to another.
std::size_t weld_vertices(MeshFile& mesh, double weld);

/// What becomes a surface.
enum class MeshSurfaces : std::uint8_t {
  of_groups,  ///< every pair of group and material
  of_faces    ///< every face
};

/// "GROUP/MATERIAL", or what there is of it: what the surface of a face, or of its group, is called.
/// @param shown  the file, whose name serves where there is neither
std::string label_of(const MeshFile& mesh, const MeshFile::Face& face, const std::string& shown);

/// Puts a mesh (its vertices placed) into the scene.
/// @param materials  by the mesh's own material
/// @param shown      the file in notes and messages
/// @return           of each new surface the position of its first face
/// @throws core::InputError  a face that crosses itself, or none that is left
std::vector<std::size_t> import_mesh(SceneBuilder& builder, const MeshFile& mesh,
                                     const std::vector<MaterialId>& materials, const MeshRepair& repair,
                                     const std::string& shown, MeshSurfaces surfaces = MeshSurfaces::of_groups);

}  // namespace interflect::scene::io
