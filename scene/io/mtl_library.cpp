#include "scene/io/mtl_library.h"

#include <algorithm>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/mtl_material.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {

const std::vector<MtlEntry>& MtlLibrary::entries_of(const std::filesystem::path& file, const std::string& mesh) {
  if (const auto at = files_.find(file); at != files_.end()) return at->second;
  const std::string shown = file.lexically_normal().string();
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw core::InputError(mesh, "there is no file '" + shown_word(shown) + "', which its mtllib names");
  return files_.emplace(file, read_mtl(file, shown)).first->second;
}

std::optional<MaterialId> MtlLibrary::use(SceneBuilder& builder, std::span<const std::filesystem::path> files,
                                          const std::string& name, const std::string& mesh) {
  for (const std::filesystem::path& file : files) {
    const auto& entries = entries_of(file, mesh);
    const auto entry =
        std::find_if(entries.begin(), entries.end(), [&](const MtlEntry& e) { return e.name == trimmed(name); });
    if (entry == entries.end()) continue;
    if (const auto known = used_.find(&*entry); known != used_.end()) return known->second;
    MtlMaterial read = mtl_material(*entry, builder.scene().channels);
    std::string keys;
    for (const std::string& key : read.left_out) keys += (keys.empty() ? "" : ", ") + key;
    if (!keys.empty()) left_out_.push_back(shown_word(name) + " (" + keys + ")");
    return used_.emplace(&*entry, builder.add_material(std::move(read.material))).first->second;
  }
  return std::nullopt;
}

void MtlLibrary::say_left_out(SceneBuilder& builder, const std::string& mesh) {
  constexpr std::size_t most = 3;
  if (left_out_.empty()) return;
  std::string text = core::format("%zu material%s of MTL files without what is not understood: ", left_out_.size(),
                                  left_out_.size() == 1 ? "" : "s");
  for (std::size_t k = 0; k < std::min(most, left_out_.size()); ++k) text += (k > 0 ? ", " : "") + left_out_[k];
  builder.scene().warnings.push_back({mesh, text + (left_out_.size() > most ? ", .." : "")});
  left_out_.clear();
}

}  // namespace interflect::scene::io
