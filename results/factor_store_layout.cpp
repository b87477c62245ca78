#include "results/factor_store_layout.h"

#include <algorithm>

#include "core/error.h"

namespace interflect::results::store_layout {

void require_store(const Hdf5File& file) {
  if (!file.has("format")) throw core::InputError(file.path().string(), "this HDF5 file holds no view factors");
  if (const std::string format = file.note("format"); format != format_name)
    throw core::InputError(file.path().string(), std::string("'") + format_name + "' is expected, not '" +
                                                     core::single_line(format.substr(0, 60)) + "'");
}

void require_sizes(const Hdf5File& file, const std::string& name, const Sizes& sizes) {
  if (file.sizes_of(name) != sizes)
    throw core::InputError(file.path().string(), "'" + name + "' does not have the size of the rest");
}

void require_digest(const Hdf5File& file, const std::string& stored, const std::string& expected) {
  if (stored != expected)
    throw core::InputError(file.path().string(), "its view factors are of another geometry (digest " +
                                                     core::single_line(stored.substr(0, 40)) + ", not " + expected +
                                                     ")");
}

std::vector<double> read_doubles(const Hdf5File& file, const std::string& name, std::uint64_t count) {
  require_sizes(file, name, {count});
  std::vector<double> out(count);
  file.read(name, {0}, {count}, out.data());
  return out;
}

/// Empty where there is none.
std::vector<double> read_if_there(const Hdf5File& file, const std::string& name, std::uint64_t count) {
  return file.has(name) ? read_doubles(file, name, count) : std::vector<double>();
}

std::vector<Vec3> read_points(const Hdf5File& file, const std::string& name, std::uint64_t count) {
  require_sizes(file, name, {count, 3});
  std::vector<double> numbers(3 * count);
  file.read(name, {0, 0}, {count, 3}, numbers.data());
  std::vector<Vec3> out(count);
  for (std::size_t i = 0; i < count; ++i) out[i] = Vec3(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
  return out;
}

/// Number of elements, which the file is large enough for.
std::uint64_t element_count(const Hdf5File& file) {
  const Sizes sizes = file.sizes_of("area");
  std::error_code error;
  if (sizes.size() != 1 || sizes[0] > std::filesystem::file_size(file.path(), error) / sizeof(double))
    throw DamagedFile(file.path().string(), "'area' promises more than the file holds");
  return sizes[0];
}

Index tile_size(const Hdf5File& file, std::uint64_t elements) {
  const std::uint64_t tile = file.count("tile");
  if (tile == 0 || tile > std::max<std::uint64_t>(elements, 1))
    throw core::InputError(file.path().string(), "'tile' is no size of a tile");
  return static_cast<Index>(tile);
}

std::vector<std::uint8_t> read_done(const Hdf5File& file, Index across) {
  const Sizes sizes{size_of(across), size_of(across)};
  require_sizes(file, "tile_done", sizes);
  std::vector<std::uint8_t> done(sizes[0] * sizes[1]);
  file.read("tile_done", {0, 0}, sizes, done.data());
  return done;
}

}  // namespace interflect::results::store_layout
