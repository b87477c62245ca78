#pragma once

#include <filesystem>
#include <vector>

namespace interflect::results {

/// Where a run puts its files: made with its parents, and tried, so that hours of work are not spent on what cannot be
/// kept.  When it ends, directories that it made and that hold nothing (the run was refused, or stopped) are removed.
class OutputDirectory {
 public:
  /// @throws core::InputError  naming the directory
  explicit OutputDirectory(const std::filesystem::path& directory);
  ~OutputDirectory() { remove_empty(); }
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

 private:
  void remove_empty() const;

  std::vector<std::filesystem::path> made_;  ///< the innermost first
};

/// @param bytes  that are going to be written there
/// @throws core::InputError  where its disk has not that much left: what cannot be kept is not begun
void require_disk_room(const std::filesystem::path& directory, double bytes);

}  // namespace interflect::results
