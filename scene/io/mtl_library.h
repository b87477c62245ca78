#pragma once

#include <map>
#include <optional>
#include <span>

#include "scene/builder.h"
#include "scene/io/mtl_file.h"

namespace interflect::scene::io {

/// Materials of MTL files, which enter the scene as faces ask for them, each once.
class MtlLibrary {
 public:
  /// @param files  that the mesh names, searched in their order
  /// @param mesh   in messages
  /// @return       nothing where none of them has the material
  /// @throws core::InputError  a file that is missing or cannot be read, a material that cannot be
  std::optional<MaterialId> use(SceneBuilder& builder, std::span<const std::filesystem::path> files,
                                const std::string& name, const std::string& mesh);

  /// Says, in one warning, what was left out of the materials that entered since the last time.
  void say_left_out(SceneBuilder& builder, const std::string& mesh);

 private:
  const std::vector<MtlEntry>& entries_of(const std::filesystem::path& file, const std::string& mesh);

  std::map<std::filesystem::path, std::vector<MtlEntry>> files_;
  std::map<const MtlEntry*, MaterialId> used_;
  std::vector<std::string> left_out_;  ///< "lamp (Ke)"
};

}  // namespace interflect::scene::io
