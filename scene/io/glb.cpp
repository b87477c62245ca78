// GLB, the container of glTF 2.0: 12 bytes (magic, version, size), then chunks of 8 bytes (size, kind) and their
// content: the text first, the binary part behind it.
#include "scene/io/glb.h"

#include "core/error.h"
#include "scene/io/assimp_guard.h"

namespace interflect::scene::io {
namespace {

constexpr std::size_t header = 12, chunk_header = 8;

/// The content of the chunk that `rest` begins with.
std::string_view content_of_chunk(std::string_view rest, const std::string& shown) {
  if (rest.size() < chunk_header || little_endian(rest, 0) > rest.size() - chunk_header)
    throw core::InputError(shown, "the file is shorter than its header says");
  return rest.substr(chunk_header, little_endian(rest, 0));
}

std::string number(std::size_t n) {
  std::string out(4, '\0');
  for (std::size_t k = 0; k < 4; ++k) out[k] = static_cast<char>(n >> (8 * k) & 0xFF);
  return out;
}

}  // namespace

GlbParts glb_parts(std::string_view bytes, const std::string& shown) {
  if (bytes.size() < header || little_endian(bytes, 8) > bytes.size())
    throw core::InputError(shown, "the file is shorter than its header says");
  GlbParts parts;
  parts.text = content_of_chunk(bytes.substr(header), shown);
  const std::string_view rest = bytes.substr(header + chunk_header + parts.text.size());
  if (rest.size() >= chunk_header) parts.binary = content_of_chunk(rest, shown);
  while (!parts.text.empty() && parts.text.back() == '\0') parts.text.remove_suffix(1);
  if (parts.text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw core::InputError(shown, "the file has no JSON part");
  return parts;
}

std::string glb_bytes(std::string text, std::string_view binary) {
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::size_t padding = (4 - binary.size() % 4) % 4;
  std::string body = number(text.size()) + "JSON" + text;
  if (!binary.empty())
    body +=
        number(binary.size() + padding) + std::string("BIN\0", 4) + std::string(binary) + std::string(padding, '\0');
  return "glTF" + number(2) + number(header + body.size()) + body;
}

}  // namespace interflect::scene::io
