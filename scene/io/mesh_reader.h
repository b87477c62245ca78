#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/vec.h"

namespace interflect::scene::io {

/// A mesh file as it is: nothing moved, repaired or triangulated yet.  Every index is in range and every coordinate
/// finite.
struct MeshFile {
  struct Face {
    std::uint32_t first, corners;  ///< indices[first .. first + corners), corners >= 3
    std::uint32_t group, material;
  };
  std::vector<Vec3> vertices;  ///< in the file's unit
  std::vector<std::uint32_t> indices;
  std::vector<Face> faces;
  std::vector<std::string> groups, materials;  ///< their names, "" where the file gives none
  std::vector<std::string> material_files;     ///< what each "mtllib" of an OBJ names
  bool single_precision = false;               ///< the format or its reader carries floats
  std::vector<std::string> notes;              ///< what was left out: "12 points and lines ignored"
};

/// Names in the order in which they first appear.
class NameList {
 public:
  std::uint32_t index_of(const std::string& name) {
    const auto [at, is_new] = at_.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
    if (is_new) names_.push_back(name);
    return at->second;
  }
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::uint32_t> at_;
};

/// What files of the formats that are read end in: ".obj", ..
std::vector<std::string> mesh_extensions();

/// Reads OBJ in double precision; PLY, STL, glTF and GLB in single precision; VTU and VTP in the file's own.
/// @param shown  how messages name the file
/// @throws core::InputError  "FILE: .." or "FILE:LINE: ..": unknown, broken or lying files, and files without a face
MeshFile read_mesh(const std::filesystem::path& file, const std::string& shown);

// The readers behind it, one a file.
MeshFile read_obj(const std::filesystem::path& file, const std::string& shown);
MeshFile read_by_assimp(const std::filesystem::path& file, const std::string& shown);

}  // namespace interflect::scene::io
