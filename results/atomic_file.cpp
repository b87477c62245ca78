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

/// So that the rename survives a power cut; a file system that cannot is no reason to fail.
void flush_directory_of(const std::filesystem::path& file) {
  const std::filesystem::path parent = file.has_parent_path() ? file.parent_path() : ".";
  const int directory = ::open(parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory < 0) return;
  ::fsync(directory);
  ::close(directory);
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path target) : target_(std::move(target)) {
  if (std::error_code ignored; target_.filename().empty() || std::filesystem::is_directory(target_, ignored))
    fail(target_, EISDIR);
  for (int attempt = 0; descriptor_ < 0; ++attempt) {
    name_ = target_;
    name_.replace_filename(core::format(".%s.%d.%d", target_.filename().c_str(), ::getpid(), attempt));
    descriptor_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && (errno != EEXIST || attempt == 10000)) fail(target_, errno);
  }
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!kept_) ::unlink(name_.c_str());
}

void AtomicFile::put(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(target_, written < 0 ? errno : EIO);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::flush() {
  put(gathered_);
  gathered_.clear();
}

void AtomicFile::write(std::string_view bytes) {
  constexpr std::size_t piece = 1 << 20;
  if (gathered_.size() + bytes.size() >= piece) flush();
  if (bytes.size() >= piece) return put(bytes);
  gathered_ += bytes;
}

void AtomicFile::write_over(std::uint64_t position, std::string_view bytes) {
  flush();
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(position));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(target_, written < 0 ? errno : EIO);
    bytes.remove_prefix(static_cast<std::size_t>(written));
    position += static_cast<std::uint64_t>(written);
  }
}

void AtomicFile::keep() {
  flush();
  if (::fsync(descriptor_) != 0) fail(target_, errno);
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0 || ::rename(name_.c_str(), target_.c_str()) != 0) fail(target_, errno);
  kept_ = true;
  flush_directory_of(target_);
}

void keep_as(const std::filesystem::path& written, const std::filesystem::path& file) {
  const int descriptor = ::open(written.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail(file, errno);
  const int flushed = ::fsync(descriptor), error = errno;
  ::close(descriptor);
  if (flushed != 0) fail(file, error);
  if (::rename(written.c_str(), file.c_str()) != 0) fail(file, errno);
  flush_directory_of(file);
}

void write_atomically(const std::filesystem::path& file, std::string_view bytes) {
  AtomicFile temporary(file);
  temporary.write(bytes);
  temporary.keep();
}

void require_writable(const std::filesystem::path& directory) {
  if (std::error_code ignored; !std::filesystem::is_directory(directory, ignored)) fail(directory, ENOTDIR);
  try {
    AtomicFile probe(directory / "probe");
    probe.write("?");
    probe.flush();
  } catch (const core::InputError& problem) {
    const std::string text = problem.what();
    throw core::InputError(directory.string(), text.substr(text.find(": ") + 2));
  }
}

}  // namespace interflect::results
