#include "results/output_directory.h"

#include <unistd.h>

#include <system_error>

#include "core/error.h"
#include "core/format.h"
#include "results/atomic_file.h"

namespace interflect::results {

OutputDirectory::OutputDirectory(const std::filesystem::path& directory) {
  std::error_code error;
  for (auto at = directory; !at.empty() && !std::filesystem::exists(at, error); at = at.parent_path())
    made_.push_back(at);
  try {
    std::filesystem::create_directories(directory, error);
    if (error) throw core::InputError(directory.string(), "cannot be written: " + error.message());
    require_writable(directory);
  } catch (...) {
    remove_empty();
    throw;
  }
}

void OutputDirectory::remove_empty() const {
  for (const std::filesystem::path& directory : made_) ::rmdir(directory.c_str());  // refused where something is in it
}

void require_disk_room(const std::filesystem::path& directory, double bytes) {
  std::error_code error;
  const auto left = static_cast<double>(std::filesystem::space(directory, error).available);
  if (error || bytes <= left) return;  // whose system does not tell finds out by writing
  throw core::InputError(directory.string(),
                         core::format("up to %s are needed, and its disk has %s left",
                                      core::format_bytes(bytes).c_str(), core::format_bytes(left).c_str()));
}

}  // namespace interflect::results
