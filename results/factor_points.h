#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "measure/sensor_points.h"
#include "results/hdf5_file.h"

/// View factors of sensor points as files know them: F_{dA->j} of point s and element j, an error for each, beside the
/// matrix.
namespace interflect::results {

/// Row s of F_{dA->j} and of its errors [1].
using PointFactorRows = std::function<void(Index s, std::span<double> F, std::span<double> error)>;

/// What is exported of them; no points: nothing.
struct PointFactors {
  std::vector<measure::SensorPoint> points;
  PointFactorRows rows;
};

/// The same sensors, positions and normals, bit by bit, in the same order.
bool same_points(std::span<const measure::SensorPoint> a, std::span<const measure::SensorPoint> b);

/// The group `sensors` of a store of view factors (docs/view_factor_files.md); there is none where there are no points.
namespace point_group {

void make(Hdf5File& store, std::span<const measure::SensorPoint> points, std::uint64_t elements);
/// @param elements  that the matrix is of   @throws core::InputError  sizes that do not fit
std::vector<measure::SensorPoint> points(const Hdf5File& store, std::uint64_t elements);
std::vector<std::uint8_t> done(const Hdf5File& store, std::uint64_t points);
/// Fewer numbers than elements: the rest is 0.
void write_row(Hdf5File& store, Index s, std::span<const double> F, std::span<const double> error);
void read_row(const Hdf5File& store, Index s, std::span<double> F, std::span<double> error);
void write_sums(Hdf5File& store, std::uint64_t points, std::uint64_t elements);
/// Bytes that the group takes.
std::uint64_t bytes(std::uint64_t points, std::uint64_t elements);

}  // namespace point_group

}  // namespace interflect::results
