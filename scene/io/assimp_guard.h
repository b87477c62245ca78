#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace interflect::scene::io {

/// Refuses a PLY, STL, glTF or GLB file that promises more than it holds, or whose nodes form a ring: assimp believes headers,
/// and would take the memory, or recurse, before it notices.
/// @return  how many faces its meshes say they have, where that is plain to see: assimp drops faulty ones without a word
/// @throws core::InputError  "FILE: .."
std::optional<std::size_t> require_honest(const std::filesystem::path& file, const std::string& shown);

}  // namespace interflect::scene::io
