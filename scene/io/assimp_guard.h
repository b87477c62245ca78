#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace interflect::scene::io {

/// Refuses a PLY, STL, glTF or GLB file that promises more than it holds, or whose nodes form a ring: assimp believes headers,
/// and would take the memory, read beyond it, or recurse, before it notices.
/// @return  how many faces its meshes say they have, where that is plain to see: assimp drops faulty ones without a word
/// @throws core::InputError  "FILE: .."
std::optional<std::size_t> require_honest(const std::filesystem::path& file, const std::string& shown);

// Behind it, one format a file.
std::optional<std::size_t> require_honest_ply(std::string_view bytes, const std::string& shown);
std::optional<std::size_t> require_honest_stl(std::string_view bytes, const std::string& shown);
std::optional<std::size_t> require_honest_gltf(std::string_view bytes, const std::filesystem::path& file,
                                               const std::string& shown);

/// A 32-bit number, the lowest byte first.
inline std::size_t little_endian(std::string_view bytes, std::size_t at) {
  std::size_t value = 0;
  for (std::size_t k = 4; k-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

}  // namespace interflect::scene::io
