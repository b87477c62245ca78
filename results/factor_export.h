#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "results/factor_points.h"
#include "results/factors.h"

/// A finished matrix of view factors in the files of others (docs/view_factor_files.md).  Rows stream through: no file
/// is held in memory.  All are written as AtomicFile does, and throw core::InputError as it does.
namespace interflect::results {

/// NumPy: F, error (n x n), area, row_sum, row_error (n), normal, centroid (n x 3), name (n); and of S points sensor_F,
/// sensor_error (S x n), sensor_row_sum, sensor_row_error, sensor_name, sensor_index (S), sensor_position,
/// sensor_normal (S x 3); environment, environment_error, closure_change (n) where there are such.  Asks for the rows
/// twice.
void write_factors_npz(const std::filesystem::path& file, const FactorElements& elements, const FactorRows& rows,
                       const PointFactors& points = {});

/// Matrix Market, coordinate real general, 17 digits: the entries F_ij that are not 0.  Errors have no place in it.
void write_factors_mtx(const std::filesystem::path& file, const FactorElements& elements, const FactorRows& rows);
/// The same of points: a row each, in their order.
void write_point_factors_mtx(const std::filesystem::path& file, const PointFactors& points, Index elements);

/// `i,j,F,error` with 17 digits, elements numbered from 0; j is `environment` for what reaches none of them, where that
/// is known.  Pairs whose F and error are both 0 are left out.
void write_factors_csv(const std::filesystem::path& file, const FactorElements& elements, const FactorRows& rows);

/// `from,to,F,error`: F_GH = sum_{i in G} A_i sum_{j in H} F_ij / A_G, groups in the order of their first elements;
/// errors add, which bounds the sum's.  Pairs as above.  Asks for the rows group by group.
/// @param group  an element's: elements.name, or whatever else is to be summed over
void write_grouped_factors_csv(const std::filesystem::path& file, const FactorElements& elements,
                               const FactorRows& rows, std::span<const std::string> group);

/// `sensor,index,j,F,error`, as `write_factors_csv`; index as in a solve's sensors.csv.
void write_point_factors_csv(const std::filesystem::path& file, const PointFactors& points, Index elements);

/// `sensor,index,to,F,error`: sums over the elements of each group.
void write_grouped_point_factors_csv(const std::filesystem::path& file, const PointFactors& points,
                                     std::span<const std::string> group);

/// Most bytes that all entries of n elements and their points take on the disk as .npz, .mtx or .csv; 0 as .h5, which
/// is there already.
double most_export_bytes(const std::filesystem::path& file, std::uint64_t elements, std::uint64_t points);

}  // namespace interflect::results
