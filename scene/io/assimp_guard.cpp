#include "scene/io/assimp_guard.h"

#include "core/error.h"
#include "core/format.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {

/// 80 bytes, a count, 50 bytes a triangle; or text that begins with "solid".
GuardedFile guarded_stl(std::string bytes, const std::string& shown) {
  constexpr std::size_t head = 84, each = 50;
  const bool text = bytes.starts_with("solid");
  if (bytes.size() < head && !text)
    throw core::InputError(shown, core::format("%zu bytes are too few for an STL file", bytes.size()));
  if (bytes.size() < head || (text && bytes.find("facet") != std::string::npos))
    return {std::move(bytes), std::nullopt};
  const std::size_t triangles = little_endian(bytes, 80), size = bytes.size();
  if (triangles <= (size - head) / each) return {std::move(bytes), triangles};
  throw core::InputError(shown, core::format("the header promises %zu triangles, in %zu bytes", triangles, size));
}

GuardedFile read_guarded(const std::filesystem::path& file, const std::string& shown) {
  std::string bytes = read_bytes(file, shown);
  if (bytes.empty()) throw core::InputError(shown, "the file is empty");
  const std::string extension = core::lower_case(file.extension().string());
  if (extension == ".ply") return guarded_ply(std::move(bytes), shown);
  if (extension == ".stl") return guarded_stl(std::move(bytes), shown);
  return guarded_gltf(bytes, file, shown);
}

}  // namespace interflect::scene::io
