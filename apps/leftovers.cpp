#include "apps/leftovers.h"

#include <algorithm>
#include <cctype>

namespace interflect::apps {
namespace {

bool is_ours(const std::filesystem::path& extension) {
  return extension == ".png" || extension == ".vtu" || extension == ".csv" || extension == ".json" ||
         extension == ".h5";
}

/// STEM, or STEM_2, STEM_3, ..
bool is_of(const std::string& name, const std::string& stem) {
  if (name.rfind(stem, 0) != 0) return false;
  const std::string rest = name.substr(stem.size());
  if (rest.empty()) return true;
  return rest.size() > 1 && rest[0] == '_' &&
         std::all_of(rest.begin() + 1, rest.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace

void remove_leftovers(const std::filesystem::path& folder, const std::vector<std::string>& stems) {
  std::error_code error;
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::filesystem::path& file = entry.path();
    if (!entry.is_regular_file(error) || !is_ours(file.extension())) continue;
    if (std::any_of(stems.begin(), stems.end(), [&](const std::string& s) { return is_of(file.stem().string(), s); }))
      found.push_back(file);
  }
  for (const std::filesystem::path& file : found) std::filesystem::remove(file, error);
}

}  // namespace interflect::apps
