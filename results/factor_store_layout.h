#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/vec.h"
#include "results/hdf5_file.h"

/// The data sets of a store of view factors (docs/view_factor_files.md), read with checks of what they promise: what
/// its writer, which goes on with a begun one, and its reader share.  All throw core::InputError in one line.
namespace interflect::results::store_layout {

using Sizes = Hdf5File::Sizes;

inline constexpr const char* format_name = "interflect/view-factors/1";

inline std::uint64_t size_of(Index count) { return static_cast<std::uint64_t>(count); }

void require_store(const Hdf5File& file);
void require_sizes(const Hdf5File& file, const std::string& name, const Sizes& sizes);
void require_digest(const Hdf5File& file, const std::string& stored, const std::string& expected);
std::vector<double> read_doubles(const Hdf5File& file, const std::string& name, std::uint64_t count);
/// Empty where there is none.
std::vector<double> read_if_there(const Hdf5File& file, const std::string& name, std::uint64_t count);
std::vector<Vec3> read_points(const Hdf5File& file, const std::string& name, std::uint64_t count);
/// Number of elements, which the file is large enough for.
std::uint64_t element_count(const Hdf5File& file);
Index tile_size(const Hdf5File& file, std::uint64_t elements);
std::vector<std::uint8_t> read_done(const Hdf5File& file, Index across);

}  // namespace interflect::results::store_layout
