#include "scene/io/assimp_guard.h"

#include "core/error.h"
#include "core/format.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {

GuardedFile read_guarded(const std::filesystem::path& file, const std::string& shown) {
  std::string bytes = read_bytes(file, shown);
  if (bytes.empty()) throw core::InputError(shown, "the file is empty");
  const std::string extension = core::lower_case(file.extension().string());
  if (extension == ".ply") return guarded_ply(std::move(bytes), shown);
  if (extension == ".stl") return guarded_stl(std::move(bytes), shown);
  return guarded_gltf(bytes, file, shown);
}

}  // namespace interflect::scene::io
