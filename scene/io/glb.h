#pragma once

#include <string>
#include <string_view>

namespace interflect::scene::io {

/// What a GLB file holds: the text of a glTF, and the bytes that its first buffer may refer to.
struct GlbParts {
  std::string_view text, binary;
};

/// @param bytes  must outlive the parts; begins with "glTF"
/// @throws core::InputError  for a file that is shorter than its headers say, or has no text
GlbParts glb_parts(std::string_view bytes, const std::string& shown);

/// The two parts in one file again.
std::string glb_bytes(std::string text, std::string_view binary);

}  // namespace interflect::scene::io
