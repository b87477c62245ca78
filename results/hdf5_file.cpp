#include "results/hdf5_file.h"

#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "results/atomic_file.h"
#include "results/hdf5_library.h"

namespace interflect::results {

namespace {

using hdf5::Checks;
using hdf5::Handle;
using hdf5::reading;
using hdf5::Turn;
using hdf5::writing;

hid_t space_of(const Hdf5File::Sizes& sizes) {
  const std::vector<hsize_t> dims(sizes.begin(), sizes.end());
  return sizes.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr);
}

/// Texts of a fixed width, filled up with zeros: where widths vary, the library follows whatever a damaged file points
/// to.
hid_t text_type(std::size_t width) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, std::max<std::size_t>(width, 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

std::uint64_t product(const Hdf5File::Sizes& sizes) {
  std::uint64_t all = 1;
  for (const std::uint64_t size : sizes) all *= size;
  return all;
}

void make_array(hid_t file, const Checks& check, hid_t type, const std::string& name, const Hdf5File::Sizes& sizes,
                const Hdf5File::Sizes& tile) {
  const Handle space(check(space_of(sizes)), H5Sclose);
  const Handle how(check(H5Pcreate(H5P_DATASET_CREATE)), H5Pclose);
  check(H5Pset_obj_track_times(how, false));
  check(H5Pset_alloc_time(how, H5D_ALLOC_TIME_EARLY));
  if (!tile.empty()) {
    const std::vector<hsize_t> dims(tile.begin(), tile.end());
    check(H5Pset_chunk(how, static_cast<int>(dims.size()), dims.data()));
  }
  // Tiles that are never written stay holes; the small arrays are all zeros from the start.
  check(H5Pset_fill_time(how, tile.empty() ? H5D_FILL_TIME_ALLOC : H5D_FILL_TIME_NEVER));
  const Handle link(check(H5Pcreate(H5P_LINK_CREATE)), H5Pclose);
  check(H5Pset_create_intermediate_group(link, 1));
  const Handle made(check(H5Dcreate2(file, name.c_str(), type, space, link, how, H5P_DEFAULT)), H5Dclose);
}

/// An array without a cache of its tiles.
hid_t open_array(hid_t file, const Checks& check, const std::string& name) {
  const Handle how(check(H5Pcreate(H5P_DATASET_ACCESS)), H5Pclose);
  check(H5Pset_chunk_cache(how, H5D_CHUNK_CACHE_NSLOTS_DEFAULT, 0, H5D_CHUNK_CACHE_W0_DEFAULT));
  return check(H5Dopen2(file, name.c_str(), how));
}

/// A part of an array, and as much memory.
struct Part {
  Part(hid_t array, const Checks& check, const Hdf5File::Sizes& from, const Hdf5File::Sizes& sizes)
      : in_file(check(H5Dget_space(array)), H5Sclose), in_memory(check(space_of(sizes)), H5Sclose) {
    const std::vector<hsize_t> start(from.begin(), from.end()), count(sizes.begin(), sizes.end());
    if (!start.empty())
      check(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr));
  }
  Handle in_file, in_memory;
};

void write_part(const std::filesystem::path& path, hid_t file, const std::string& name, const Hdf5File::Sizes& from,
                const Hdf5File::Sizes& sizes, hid_t type, const void* values) {
  if (product(sizes) == 0) return;
  const Checks check = writing(path);
  Handle array(open_array(file, check, name), H5Dclose);
  const Part part(array, check, from, sizes);
  check(H5Dwrite(array, type, part.in_memory, part.in_file, H5P_DEFAULT, values));
  check(H5Dclose(array.release()));
}

void read_part(const std::filesystem::path& path, hid_t file, const std::string& name, const Hdf5File::Sizes& from,
               const Hdf5File::Sizes& sizes, hid_t type, void* values) {
  if (product(sizes) == 0) return;
  const Checks check = reading(path, name);
  const Handle array(open_array(file, check, name), H5Dclose);
  const Part part(array, check, from, sizes);
  check(H5Dread(array, type, part.in_memory, part.in_file, H5P_DEFAULT, values));
}

/// Access to files of the format's version 1.8: its structures carry checksums, which spares the library from following
/// damaged ones.  Later versions mark a file that is open for writing, and refuse it when its writer died.
hid_t plain_access(const Checks& check) {
  Handle how(check(H5Pcreate(H5P_FILE_ACCESS)), H5Pclose);
  check(H5Pset_libver_bounds(how, H5F_LIBVER_V18, H5F_LIBVER_V18));
  check(H5Pset_fclose_degree(how, H5F_CLOSE_STRONG));
  return how.release();
}

/// Where the disk is full before a file is laid out the library cannot close it, and follows what is no longer there
/// when the program ends: so that is found out without it.
void require_room(const std::filesystem::path& file, const Hdf5File::Room& room) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  int error = descriptor < 0 ? errno : 0;
  if (error == 0 && ::ftruncate(descriptor, static_cast<off_t>(room.apparent)) != 0) error = errno;
  if (error == 0) error = ::posix_fallocate(descriptor, 0, static_cast<off_t>(room.at_once));
  if (descriptor >= 0) ::close(descriptor);
  if (error == 0) return;
  if (descriptor >= 0) ::unlink(file.c_str());
  throw core::InputError(file.string(), "cannot be written: " + std::generic_category().message(error));
}

}  // namespace

Hdf5File Hdf5File::create(const std::filesystem::path& file, const Room& room) {
  require_room(file, room);
  const Turn turn;
  const Checks check = writing(file);
  const Handle how(plain_access(check), H5Pclose);
  return {file, check(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, how))};
}

Hdf5File Hdf5File::open(const std::filesystem::path& file, Access access) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw core::InputError(file.string(), "there is no such file");
  if (!std::filesystem::is_regular_file(file, error))
    throw core::InputError(file.string(), "this is not a regular file");
  const Turn turn;
  const htri_t is_hdf5 = H5Fis_hdf5(file.c_str());
  if (is_hdf5 == 0) throw DamagedFile(file.string(), "this is not an HDF5 file");
  const Checks check(file, "cannot be opened", Checks::Task::read);
  check(is_hdf5);
  const Handle how(plain_access(check), H5Pclose);
  const hid_t opened = H5Fopen(file.c_str(), access == Access::read ? H5F_ACC_RDONLY : H5F_ACC_RDWR, how);
  if (opened < 0 && hdf5::last_complaint().of_system == std::generic_category().message(EAGAIN))
    throw core::InputError(file.string(), "another process has it open");
  return {file, check(opened)};
}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}

Hdf5File::~Hdf5File() {
  if (file_ < 0) return;
  const Turn turn;
  H5Fclose(file_);
}

void Hdf5File::make_doubles(const std::string& name, const Sizes& sizes, const Sizes& tile) {
  const Turn turn;
  make_array(file_, writing(path_), H5T_IEEE_F64LE, name, sizes, tile);
}
void Hdf5File::make_floats(const std::string& name, const Sizes& sizes, const Sizes& tile) {
  const Turn turn;
  make_array(file_, writing(path_), H5T_IEEE_F32LE, name, sizes, tile);
}
void Hdf5File::make_bytes(const std::string& name, const Sizes& sizes) {
  const Turn turn;
  make_array(file_, writing(path_), H5T_STD_U8LE, name, sizes, {});
}
void Hdf5File::make_counts(const std::string& name, const Sizes& sizes) {
  const Turn turn;
  make_array(file_, writing(path_), H5T_STD_U64LE, name, sizes, {});
}

void Hdf5File::write_texts(const std::string& name, std::span<const std::string> texts, const Sizes& sizes) {
  std::size_t width = 1;
  for (const std::string& text : texts) width = std::max(width, text.size());
  std::string all;
  for (const std::string& text : texts) {
    all += text;
    all.append(width - text.size(), '\0');
  }
  const Turn turn;
  const Checks check = writing(path_);
  const Handle type(text_type(width), H5Tclose);
  make_array(file_, check, type, name, sizes, {});
  write_part(path_, file_, name, Sizes(sizes.size(), 0), sizes, type, all.data());
}

void Hdf5File::write_texts(const std::string& name, std::span<const std::string> texts) {
  write_texts(name, texts, {texts.size()});
}

void Hdf5File::write_note(const std::string& name, const std::string& text) { write_texts(name, {&text, 1}, {}); }

void Hdf5File::write_count(const std::string& name, std::uint64_t count) {
  const Turn turn;
  const Checks check = writing(path_);
  make_array(file_, check, H5T_STD_U64LE, name, {}, {});
  const Handle array(open_array(file_, check, name), H5Dclose);
  check(H5Dwrite(array, H5T_NATIVE_UINT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &count));
}

void Hdf5File::write(const std::string& name, const Sizes& from, const Sizes& sizes, const double* values) {
  const Turn turn;
  write_part(path_, file_, name, from, sizes, H5T_NATIVE_DOUBLE, values);
}
void Hdf5File::write(const std::string& name, const Sizes& from, const Sizes& sizes, const float* values) {
  const Turn turn;
  write_part(path_, file_, name, from, sizes, H5T_NATIVE_FLOAT, values);
}
void Hdf5File::write(const std::string& name, const Sizes& from, const Sizes& sizes, const std::uint8_t* values) {
  const Turn turn;
  write_part(path_, file_, name, from, sizes, H5T_NATIVE_UINT8, values);
}
void Hdf5File::write(const std::string& name, const Sizes& from, const Sizes& sizes, const std::uint64_t* values) {
  const Turn turn;
  write_part(path_, file_, name, from, sizes, H5T_NATIVE_UINT64, values);
}
void Hdf5File::read(const std::string& name, const Sizes& from, const Sizes& sizes, double* values) const {
  const Turn turn;
  read_part(path_, file_, name, from, sizes, H5T_NATIVE_DOUBLE, values);
}
void Hdf5File::read(const std::string& name, const Sizes& from, const Sizes& sizes, float* values) const {
  const Turn turn;
  read_part(path_, file_, name, from, sizes, H5T_NATIVE_FLOAT, values);
}
void Hdf5File::read(const std::string& name, const Sizes& from, const Sizes& sizes, std::uint8_t* values) const {
  const Turn turn;
  read_part(path_, file_, name, from, sizes, H5T_NATIVE_UINT8, values);
}

void Hdf5File::read(const std::string& name, const Sizes& from, const Sizes& sizes, std::uint64_t* values) const {
  const Turn turn;
  read_part(path_, file_, name, from, sizes, H5T_NATIVE_UINT64, values);
}

bool Hdf5File::has(const std::string& name) const {
  const Turn turn;
  return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0;
}

std::string Hdf5File::note(const std::string& name) const {
  if (sizes_of(name) != Sizes{}) throw core::InputError(path_.string(), "'" + name + "' is not one text");
  return read_texts(name, 1)[0];
}

std::vector<std::string> Hdf5File::texts(const std::string& name) const {
  const Sizes sizes = sizes_of(name);
  if (sizes.size() != 1) throw core::InputError(path_.string(), "'" + name + "' is not a list of texts");
  return read_texts(name, sizes[0]);
}

std::vector<std::string> Hdf5File::read_texts(const std::string& name, std::uint64_t count) const {
  const Turn turn;
  const Checks check = reading(path_, name);
  const Handle array(open_array(file_, check, name), H5Dclose), stored(check(H5Dget_type(array)), H5Tclose);
  const std::uint64_t width = H5Tget_size(stored);
  if (H5Tget_class(stored) != H5T_STRING || check(H5Tis_variable_str(stored)) > 0 || width == 0)
    throw core::InputError(path_.string(), "'" + name + "' holds no texts");
  std::error_code error;
  if (count > std::filesystem::file_size(path_, error) / width)
    throw DamagedFile(path_.string(), "'" + name + "' promises more than the file holds");
  if (count == 0) return {};
  const Handle type(text_type(width), H5Tclose);
  std::string all(count * width, '\0');
  check(H5Dread(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()));
  std::vector<std::string> out;
  for (std::uint64_t k = 0; k < count; ++k) {
    out.push_back(all.substr(k * width, width));
    out.back().erase(out.back().find_last_not_of('\0') + 1);
  }
  return out;
}

std::uint64_t Hdf5File::count(const std::string& name) const {
  if (sizes_of(name) != Sizes{}) throw core::InputError(path_.string(), "'" + name + "' is not one number");
  const Turn turn;
  const Checks check = reading(path_, name);
  const Handle array(open_array(file_, check, name), H5Dclose);
  std::uint64_t value = 0;
  check(H5Dread(array, H5T_NATIVE_UINT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value));
  return value;
}

Hdf5File::Sizes Hdf5File::sizes_of(const std::string& name) const {
  const Turn turn;
  const Checks check = reading(path_, name);
  const Handle array(open_array(file_, check, name), H5Dclose), space(check(H5Dget_space(array)), H5Sclose);
  std::vector<hsize_t> sizes(static_cast<std::size_t>(check(H5Sget_simple_extent_ndims(space))));
  check(H5Sget_simple_extent_dims(space, sizes.data(), nullptr));
  return {sizes.begin(), sizes.end()};
}

void Hdf5File::flush() {
  const Turn turn;
  writing(path_)(H5Fflush(file_, H5F_SCOPE_GLOBAL));
}

void write_whole(const std::filesystem::path& file, const Hdf5File::Room& room,
                 const std::function<void(Hdf5File&)>& fill) {
  const std::filesystem::path unborn = file.string() + ".partial";
  try {
    Hdf5File stored = Hdf5File::create(unborn, room);
    fill(stored);
    stored.flush();
  } catch (...) {
    std::error_code error;
    std::filesystem::remove(unborn, error);
    throw;
  }
  keep_as(unborn, file);
}

}  // namespace interflect::results
