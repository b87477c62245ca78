#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace interflect::results {

/// A file that is written piece by piece under a temporary name beside its target, and takes the target's name when it
/// is kept. One that is not kept disappears. Everything throws core::InputError: "out/F.npz: cannot be written: No
/// space left on device".
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);                               ///< behind the rest; gathered to large pieces
  void write_over(std::uint64_t position, std::string_view bytes);  ///< over what was written before
  void flush();                                                     ///< hands what was gathered to the system
  void keep();                                                      ///< flushed to the disk and renamed: the last call

 private:
  void put(std::string_view bytes);

  std::filesystem::path target_, name_;
  int descriptor_ = -1;
  bool kept_ = false;
  std::string gathered_;
};

/// Gives a file that lies on the disk its name, as write_atomically does: for files that a library has written.
/// @throws core::InputError  as above
void keep_as(const std::filesystem::path& written, const std::filesystem::path& file);

/// Puts `bytes` into a file all at once: written under a temporary name beside it, flushed to the disk, renamed.  Who
/// reads the file finds the old contents or the new ones; a write that fails leaves the old file and nothing else.
/// @throws core::InputError  "out/solution.vtu: cannot be written: No space left on device"
void write_atomically(const std::filesystem::path& file, std::string_view bytes);

/// Writes a byte in a file of the directory that is gone at once.
/// @throws core::InputError  naming the directory, where that cannot be done
void require_writable(const std::filesystem::path& directory);

}  // namespace interflect::results
