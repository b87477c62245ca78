#pragma once

#include <filesystem>

#include "scene/builder.h"
#include "scene/io/json_document.h"
#include "scene/io/material_library.h"
#include "scene/io/mesh_reader.h"
#include "scene/io/mtl_library.h"
#include "scene/io/placement.h"

namespace interflect::scene::io {

/// The key "geometry": polygons, boxes and mesh files, which become surfaces of the scene in the order of the file.
class GeometryReader {
 public:
  /// @param folder  what the paths of mesh files are relative to
  /// @param shown   the scene file, in notes
  GeometryReader(SceneBuilder& builder, MaterialLibrary& materials, const LengthUnit& unit,
                 std::filesystem::path folder, std::string shown)
      : builder_(builder), materials_(materials), unit_(unit), folder_(std::move(folder)), shown_(std::move(shown)) {}

  void read(const JsonNode& geometry);

 private:
  void read_polygon(const JsonNode& entry, const std::string& name);
  void read_box(const JsonNode& entry, const std::string& name);
  void read_file(const JsonNode& entry);
  std::vector<MaterialId> map_materials(const JsonNode& entry, const MeshFile& mesh, const std::string& shown);
  /// What the key "unmapped" gives a name that is not mapped.
  std::optional<MaterialId> unmapped(const JsonNode& entry, const MeshFile& mesh, const std::string& name,
                                     const std::string& shown);

  SceneBuilder& builder_;
  MaterialLibrary& materials_;
  MtlLibrary mtl_;
  LengthUnit unit_;
  std::filesystem::path folder_;
  std::string shown_;
};

}  // namespace interflect::scene::io
