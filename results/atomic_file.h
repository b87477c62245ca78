#pragma once

#include <filesystem>
#include <string_view>

namespace interflect::results {

/// Puts `bytes` into a file all at once: written under a temporary name beside it, flushed to the disk, renamed.  Who
/// reads the file finds the old contents or the new ones; a write that fails leaves the old file and nothing else.
/// @throws core::InputError  "out/solution.vtu: cannot be written: No space left on device"
void write_atomically(const std::filesystem::path& file, std::string_view bytes);

/// Writes a byte in a file of the directory that is gone at once.
/// @throws core::InputError  naming the directory, where that cannot be done
void require_writable(const std::filesystem::path& directory);

}  // namespace interflect::results
