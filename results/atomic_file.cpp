#include "results/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "core/error.h"
#include "core/format.h"

namespace interflect::results {

namespace {

[[noreturn]] void fail(const std::filesystem::path& place, int error) {
  throw core::InputError(place.string(), "cannot be written: " + std::generic_category().message(error));
}

/// A file beside its target that disappears unless it is given its name.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target) : target_(target) {
    for (int attempt = 0; descriptor_ < 0; ++attempt) {
      name_ = target;
      name_.replace_filename(core::format(".%s.%d.%d", target.filename().c_str(), ::getpid(), attempt));
      descriptor_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ < 0 && (errno != EEXIST || attempt == 10000)) fail(target_, errno);
    }
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!kept_) ::unlink(name_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) fail(target_, written < 0 ? errno : EIO);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void keep() {
    if (::fsync(descriptor_) != 0) fail(target_, errno);
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0 || ::rename(name_.c_str(), target_.c_str()) != 0) fail(target_, errno);
    kept_ = true;
    flush_directory();
  }

 private:
  /// So that the rename survives a power cut; a file system that cannot is no reason to fail.
  void flush_directory() const {
    const std::filesystem::path parent = target_.has_parent_path() ? target_.parent_path() : ".";
    const int directory = ::open(parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (directory < 0) return;
    ::fsync(directory);
    ::close(directory);
  }

  const std::filesystem::path& target_;
  std::filesystem::path name_;
  int descriptor_ = -1;
  bool kept_ = false;
};

}  // namespace

void write_atomically(const std::filesystem::path& file, std::string_view bytes) {
  if (std::error_code ignored; file.filename().empty() || std::filesystem::is_directory(file, ignored))
    fail(file, EISDIR);
  TemporaryFile temporary(file);
  temporary.write(bytes);
  temporary.keep();
}

void require_writable(const std::filesystem::path& directory) {
  if (std::error_code ignored; !std::filesystem::is_directory(directory, ignored)) fail(directory, ENOTDIR);
  try {
    TemporaryFile(directory / "probe").write("?");
  } catch (const core::InputError& problem) {
    const std::string text = problem.what();
    throw core::InputError(directory.string(), text.substr(text.find(": ") + 2));
  }
}

}  // namespace interflect::results
