#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results/atomic_file.h"

namespace interflect::results {

/// CRC-32 of zip and PNG (polynomial 0x04C11DB7, reflected), piece by piece.
class Crc32 {
 public:
  void add(std::string_view bytes);
  std::uint32_t value() const { return ~state_; }

 private:
  std::uint32_t state_ = 0xFFFFFFFFu;
};

/// NumPy's archive of arrays: a zip file, nothing compressed, of one NAME.npy (format 1.0) an array.  Arrays stream
/// through, of any size (zip64 where 4 GiB are not enough); the file is written as AtomicFile does.
class NpzFile {
 public:
  /// @param zip64_from  sizes and positions from which on zip64 is used; other than its default for tests
  explicit NpzFile(const std::filesystem::path& file, std::uint64_t zip64_from = 0xFFFFFFFFu)
      : file_(file), zip64_from_(zip64_from) {}

  /// Begins an array; its bytes follow, row by row, little-endian.
  /// @param type  NumPy's name of it: "<f8"
  /// @param item  bytes of one number
  void begin(const std::string& name, const std::string& type, std::size_t item,
             const std::vector<std::uint64_t>& shape);
  void put(std::string_view bytes);
  void put(std::span<const double> numbers);
  /// @throws core::PreconditionError  unless the shape has been filled
  void end();

  void add(const std::string& name, std::span<const double> numbers, const std::vector<std::uint64_t>& shape);
  /// Texts as an array of NumPy's fixed-width type `<U..`; bytes that are not UTF-8 become U+FFFD.
  void add(const std::string& name, std::span<const std::string> texts);

  /// Writes the zip file's directory and gives the file its name.
  void keep();

 private:
  struct Entry {
    std::string name;
    std::uint64_t position = 0, size = 0;
    std::uint32_t crc = 0;
  };
  void emit(std::string_view bytes);
  std::string directory_entry(const Entry& entry) const;

  AtomicFile file_;
  std::uint64_t zip64_from_, position_ = 0, left_ = 0;
  std::vector<Entry> entries_;
  Crc32 crc_;
};

}  // namespace interflect::results
