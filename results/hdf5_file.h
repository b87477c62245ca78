#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"

namespace interflect::results {

/// A file that is none of HDF5's, or of which a part is missing or wrong.
class DamagedFile : public core::InputError {
 public:
  using core::InputError::InputError;
};

/// An HDF5 file, opened: arrays of numbers and lists of texts under names, without a type of the library's.  A name may
/// lie in a group: "sensors/F".
///
/// Space is given to arrays when they are made, and nothing of them is kept in memory: a file whose arrays exist never
/// changes its structure again, so that a process may die at any moment and leave a file that opens.  The space of what
/// was never written is a hole of the file, where its system has such.
///
/// Every call may come from any thread: they take turns.  What the library has to complain about comes as
/// core::InputError (DamagedFile where the file is at fault) with the file's name, in one line, and as nothing else.
class Hdf5File {
 public:
  enum class Access { read, change };
  using Sizes = std::vector<std::uint64_t>;  ///< of an array, or a place in it

  /// What a file will need [bytes].
  struct Room {
    std::uint64_t apparent = 1 << 20;  ///< its size, holes and all
    std::uint64_t at_once = 1 << 20;   ///< what is written before it is first flushed
  };
  /// A new file, after a trial that there is room for it; one of that name is replaced.
  static Hdf5File create(const std::filesystem::path& file, const Room& room);
  static Hdf5File open(const std::filesystem::path& file, Access access);
  ~Hdf5File();
  Hdf5File(Hdf5File&& other) noexcept;
  Hdf5File& operator=(Hdf5File&&) = delete;

  /// @param tile  of arrays that are stored in tiles: their sizes
  void make_doubles(const std::string& name, const Sizes& sizes, const Sizes& tile = {});
  void make_floats(const std::string& name, const Sizes& sizes, const Sizes& tile = {});
  void make_bytes(const std::string& name, const Sizes& sizes);
  void make_counts(const std::string& name, const Sizes& sizes);
  void write_texts(const std::string& name, std::span<const std::string> texts);
  /// A text about the whole file.
  void write_note(const std::string& name, const std::string& text);
  void write_count(const std::string& name, std::uint64_t count);

  /// The part of an array that begins at `from`, `sizes` large, row by row.
  void write(const std::string& name, const Sizes& from, const Sizes& sizes, const double* values);
  void write(const std::string& name, const Sizes& from, const Sizes& sizes, const float* values);
  void write(const std::string& name, const Sizes& from, const Sizes& sizes, const std::uint8_t* values);
  void write(const std::string& name, const Sizes& from, const Sizes& sizes, const std::uint64_t* values);
  void read(const std::string& name, const Sizes& from, const Sizes& sizes, double* values) const;
  void read(const std::string& name, const Sizes& from, const Sizes& sizes, float* values) const;
  void read(const std::string& name, const Sizes& from, const Sizes& sizes, std::uint8_t* values) const;
  void read(const std::string& name, const Sizes& from, const Sizes& sizes, std::uint64_t* values) const;

  bool has(const std::string& name) const;
  std::string note(const std::string& name) const;
  std::uint64_t count(const std::string& name) const;
  Sizes sizes_of(const std::string& name) const;
  std::vector<std::string> texts(const std::string& name) const;

  /// Hands everything to the system.
  void flush();
  const std::filesystem::path& path() const { return path_; }

 private:
  Hdf5File(std::filesystem::path path, std::int64_t file) : path_(std::move(path)), file_(file) {}

  void write_texts(const std::string& name, std::span<const std::string> texts, const Sizes& sizes);
  std::vector<std::string> read_texts(const std::string& name, std::uint64_t count) const;

  std::filesystem::path path_;
  std::int64_t file_;
};

/// A file that is there whole or not at all: filled under another name, which is renamed; a fill that fails leaves
/// nothing.
/// @throws core::InputError  it cannot be written
void write_whole(const std::filesystem::path& file, const Hdf5File::Room& room,
                 const std::function<void(Hdf5File&)>& fill);

}  // namespace interflect::results
