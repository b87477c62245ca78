#include "results/output_directory.h"

#include <unistd.h>

#include <system_error>

#include "core/error.h"
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

}  // namespace interflect::results
