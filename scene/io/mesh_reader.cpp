#include "scene/io/mesh_reader.h"

#include <algorithm>
#include <array>
#include <new>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/text_file.h"
#include "scene/io/vtk_reader.h"

namespace interflect::scene::io {
namespace {

struct Format {
  const char* extension;
  MeshFile (*read)(const std::filesystem::path&, const std::string&);
};

constexpr std::array<Format, 7> formats = {{{".obj", read_obj},
                                            {".ply", read_by_assimp},
                                            {".stl", read_by_assimp},
                                            {".gltf", read_by_assimp},
                                            {".glb", read_by_assimp},
                                            {".vtu", read_vtk},
                                            {".vtp", read_vtk}}};

const Format& format_of(const std::filesystem::path& file, const std::string& shown) {
  const std::string extension = core::lower_case(file.extension().string());
  for (const Format& format : formats)
    if (extension == format.extension) return format;
  throw core::InputError(shown, unknown_word("the mesh format", extension, mesh_extensions()));
}

}  // namespace

std::vector<std::string> mesh_extensions() {
  std::vector<std::string> known;
  for (const Format& format : formats) known.emplace_back(format.extension);
  return known;
}

MeshFile read_mesh(const std::filesystem::path& file, const std::string& shown) {
  const Format& format = format_of(file, shown);
  MeshFile mesh;
  try {
    mesh = format.read(file, shown);
  } catch (const std::bad_alloc&) {
    throw core::InputError(shown, "the file asks for more memory than there is");
  }
  if (mesh.faces.empty())
    throw core::InputError(
        shown, mesh.vertices.empty() ? "the file has no faces" : "the file has points or lines, and no faces");
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k)
    if (!mesh.vertices[k].allFinite()) throw core::InputError(shown, core::format("vertex %zu is not finite", k + 1));
  for (const std::uint32_t index : mesh.indices)
    if (index >= mesh.vertices.size())
      throw core::InputError(shown, core::format("a face refers to vertex %u of %zu", index + 1, mesh.vertices.size()));
  return mesh;
}

}  // namespace interflect::scene::io
