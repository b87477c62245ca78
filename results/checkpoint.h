#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "solvers/solver.h"

namespace interflect::results {

/// What a computation that was stopped goes on from: some matrices by name, and how far it was.
struct Checkpoint {
  struct Matrix {
    std::string name;
    solvers::ColumnMatrix values;
  };
  /// What the numbers depend on: the equations (system_digest), and settings as JSON text.
  std::string digest, settings;
  std::uint64_t step = 0;
  std::vector<Matrix> matrices;

  /// @throws core::PreconditionError  there is none
  const solvers::ColumnMatrix& matrix(const std::string& name) const;
};

/// Of e and R: what elements emit and reflect.  Together with geometry_digest it stands for a system of equations.
std::string system_digest(const std::string& of_geometry, const solvers::System& system);

/// An HDF5 file, written under another name and renamed.  Doubles as they are: what is read back has the same bits.
/// @throws core::InputError  it cannot be written
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// @param expected  its digest, settings, and the names of its matrices with their sizes (values do not count; 0 rows:
///                  any number of them)
/// @throws core::InputError  in one line: there is none; none of ours, or damaged; of another scene, or of other
/// settings
Checkpoint read_checkpoint(const std::filesystem::path& file, const Checkpoint& expected);

}  // namespace interflect::results
