#include "scene/io/assimp_guard.h"

#include <cctype>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {

/// 80 bytes, a count, 50 bytes a triangle; or text that begins with "solid".
std::optional<std::size_t> require_honest_stl(std::string_view bytes, const std::string& shown) {
  constexpr std::size_t head = 84, each = 50;
  const bool text = bytes.starts_with("solid");
  if (bytes.size() < head) {
    if (!text) throw core::InputError(shown, core::format("%zu bytes are too few for an STL file", bytes.size()));
    return std::nullopt;
  }
  const std::size_t triangles = little_endian(bytes, 80);
  if (text && bytes.find("facet") != std::string_view::npos) return std::nullopt;
  if (triangles <= (bytes.size() - head) / each) return triangles;
  throw core::InputError(shown,
                         core::format("the header promises %zu triangles, in %zu bytes", triangles, bytes.size()));
}

std::optional<std::size_t> require_honest(const std::filesystem::path& file, const std::string& shown) {
  const std::string bytes = read_bytes(file, shown);
  if (bytes.empty()) throw core::InputError(shown, "the file is empty");
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".ply") return require_honest_ply(bytes, shown);
  if (extension == ".stl") return require_honest_stl(bytes, shown);
  return require_honest_gltf(bytes, file, shown);
}

}  // namespace interflect::scene::io
