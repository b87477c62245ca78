#pragma once

#include <filesystem>
#include <string>

#include "scene/io/mesh_reader.h"

namespace interflect::scene::io {

/// Reads VTK's XML UnstructuredGrid (.vtu) and PolyData (.vtp): triangles, quads, pixels, polygons and triangle strips;
/// other cells are counted and left out.  A cell's group is its value of the first of the cell data "group", "surface",
/// "region", "part" that is there, its material that of "material": texts as they are, numbers as "surface-3".
///
/// Our own reader: VTK's, as of 9.1, runs out of its arrays on damaged files, and ends the program.
/// @throws core::InputError  "FILE:LINE: .."
MeshFile read_vtk(const std::filesystem::path& file, const std::string& shown);

}  // namespace interflect::scene::io
