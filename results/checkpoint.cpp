#include "results/checkpoint.h"

#include <algorithm>

#include "core/error.h"
#include "results/digest.h"
#include "results/hdf5_file.h"

namespace interflect::results {
namespace {

constexpr const char* format_name = "interflect checkpoint 1";

Hdf5File::Sizes sizes_of(const solvers::ColumnMatrix& values) {
  return {static_cast<std::uint64_t>(values.rows()), static_cast<std::uint64_t>(values.cols())};
}

Hdf5File opened(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file))
    throw core::InputError(file.string(), "there is no such checkpoint to go on from");
  Hdf5File stored = Hdf5File::open(file, Hdf5File::Access::read);
  if (!stored.has("format") || stored.note("format") != format_name)
    throw core::InputError(file.string(), "this HDF5 file is no checkpoint");
  return stored;
}

}  // namespace

const solvers::ColumnMatrix& Checkpoint::matrix(const std::string& name) const {
  const auto found = std::find_if(matrices.begin(), matrices.end(), [&](const Matrix& m) { return m.name == name; });
  if (found == matrices.end()) throw core::PreconditionError("a checkpoint has no matrix '" + name + "'");
  return found->values;
}

std::string system_digest(const std::string& of_geometry, const solvers::System& system) {
  Digest digest;
  for (const char each : of_geometry) digest.add(static_cast<std::uint64_t>(each));
  digest.add(static_cast<std::uint64_t>(system.e.cols()));
  for (Index a = 0; a < system.e.rows(); ++a)
    for (Index c = 0; c < system.e.cols(); ++c) {
      digest.add(system.e(a, c));
      digest.add(system.R.reflectance()(a, c));
    }
  return digest.text();
}

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  Hdf5File::Room room;
  for (const Checkpoint::Matrix& matrix : checkpoint.matrices)
    room.apparent += sizeof(double) * static_cast<std::uint64_t>(matrix.values.size());
  room.at_once = room.apparent;
  write_whole(file, room, [&](Hdf5File& stored) {
    stored.write_note("format", format_name);
    stored.write_note("digest", checkpoint.digest);
    stored.write_note("settings", checkpoint.settings);
    stored.write_count("step", checkpoint.step);
    for (const Checkpoint::Matrix& matrix : checkpoint.matrices) {
      const Hdf5File::Sizes sizes = sizes_of(matrix.values);
      stored.make_doubles(matrix.name, sizes);
      stored.write(matrix.name, {0, 0}, sizes, matrix.values.data());
    }
  });
}

Checkpoint read_checkpoint(const std::filesystem::path& file, const Checkpoint& expected) {
  const Hdf5File stored = opened(file);
  if (stored.note("digest") != expected.digest)
    throw core::InputError(file.string(),
                           "this checkpoint is of another scene: other surfaces, elements, lights or "
                           "reflectances; without --resume it is begun anew");
  if (stored.note("settings") != expected.settings)
    throw core::InputError(file.string(),
                           "this checkpoint is of other settings: " + core::single_line(stored.note("settings")) +
                               ", not " + core::single_line(expected.settings));
  Checkpoint found{expected.digest, expected.settings, stored.count("step"), {}};
  for (const Checkpoint::Matrix& matrix : expected.matrices) {
    Hdf5File::Sizes sizes = sizes_of(matrix.values);
    const Hdf5File::Sizes there = stored.has(matrix.name) ? stored.sizes_of(matrix.name) : Hdf5File::Sizes();
    if (there.size() == 2 && sizes[0] == 0) sizes[0] = there[0];
    if (there != sizes || sizes[0] > std::filesystem::file_size(file))
      throw DamagedFile(file.string(), "'" + matrix.name + "' is missing, or has another size");
    found.matrices.push_back(
        {matrix.name, solvers::ColumnMatrix(static_cast<Index>(sizes[0]), static_cast<Index>(sizes[1]))});
    stored.read(matrix.name, {0, 0}, sizes, found.matrices.back().values.data());
    if (!found.matrices.back().values.allFinite())
      throw DamagedFile(file.string(), "'" + matrix.name + "' holds numbers that are not finite");
  }
  return found;
}

}  // namespace interflect::results
