#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace interflect::scene::io {

/// A file as assimp may see it.
struct GuardedFile {
  std::string bytes;  ///< of glTF, only what makes up its shapes is left
  /// Faces that its meshes say they have, where that is plain to see: faulty ones get lost on the way.
  std::optional<std::size_t> faces;
};

/// Refuses a PLY, STL, glTF or GLB file that promises more than it holds, or whose nodes form a ring: assimp believes
/// headers, and would take the memory, read beyond it, or recurse, before it notices.
/// @throws core::InputError  "FILE: .."
GuardedFile read_guarded(const std::filesystem::path& file, const std::string& shown);

// Behind it, one format a file.
GuardedFile guarded_ply(std::string bytes, const std::string& shown);
GuardedFile guarded_stl(std::string bytes, const std::string& shown);
GuardedFile guarded_gltf(const std::string& bytes, const std::filesystem::path& file, const std::string& shown);

/// A 32-bit number, the lowest byte first.
inline std::size_t little_endian(std::string_view bytes, std::size_t at) {
  std::size_t value = 0;
  for (std::size_t k = 4; k-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

}  // namespace interflect::scene::io
