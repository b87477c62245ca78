#include "results/factor_points.h"

#include <algorithm>
#include <numeric>

#include "core/error.h"

namespace interflect::results {

bool same_points(std::span<const measure::SensorPoint> a, std::span<const measure::SensorPoint> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const measure::SensorPoint& p, const measure::SensorPoint& q) {
                      return p.sensor == q.sensor && p.index == q.index && p.at.position == q.at.position &&
                             p.at.normal == q.at.normal;
                    });
}

namespace point_group {

namespace {

using Sizes = Hdf5File::Sizes;

std::uint64_t at(Index s) { return static_cast<std::uint64_t>(s); }

std::vector<double> coordinates(std::span<const measure::SensorPoint> points, Vec3 measure::PointIrradiance::*what) {
  std::vector<double> out;
  for (const measure::SensorPoint& point : points) {
    const Vec3& x = point.at.*what;
    out.insert(out.end(), {x.x(), x.y(), x.z()});
  }
  return out;
}

void require_sizes(const Hdf5File& store, const std::string& name, const Sizes& sizes) {
  if (store.sizes_of(name) != sizes)
    throw core::InputError(store.path().string(), "'" + name + "' does not have the size of the rest");
}

}  // namespace

void make(Hdf5File& store, std::span<const measure::SensorPoint> points, std::uint64_t elements) {
  if (points.empty()) return;
  const std::uint64_t count = points.size();
  std::vector<std::string> names;
  std::vector<std::uint64_t> indices;
  for (const measure::SensorPoint& point : points) {
    names.push_back(point.sensor);
    indices.push_back(static_cast<std::uint64_t>(point.index));
  }
  store.write_texts("sensors/name", names);
  store.make_counts("sensors/index", {count});
  for (const char* name : {"sensors/position", "sensors/normal"}) store.make_doubles(name, {count, 3});
  for (const char* name : {"sensors/row_sum", "sensors/row_error"}) store.make_doubles(name, {count});
  store.make_bytes("sensors/done", {count});
  const Sizes row = elements > 0 ? Sizes{1, elements} : Sizes{};
  for (const char* name : {"sensors/F", "sensors/error"}) store.make_doubles(name, {count, elements}, row);
  store.write("sensors/index", {0}, {count}, indices.data());
  store.write("sensors/position", {0, 0}, {count, 3}, coordinates(points, &measure::PointIrradiance::position).data());
  store.write("sensors/normal", {0, 0}, {count, 3}, coordinates(points, &measure::PointIrradiance::normal).data());
}

std::vector<measure::SensorPoint> points(const Hdf5File& store, std::uint64_t elements) {
  if (!store.has("sensors")) return {};
  const std::vector<std::string> names = store.texts("sensors/name");
  const std::uint64_t count = names.size();
  for (const char* name : {"sensors/index", "sensors/row_sum", "sensors/row_error", "sensors/done"})
    require_sizes(store, name, {count});
  for (const char* name : {"sensors/position", "sensors/normal"}) require_sizes(store, name, {count, 3});
  for (const char* name : {"sensors/F", "sensors/error"}) require_sizes(store, name, {count, elements});
  std::vector<std::uint64_t> indices(count);
  std::vector<double> positions(3 * count), normals(3 * count);
  store.read("sensors/index", {0}, {count}, indices.data());
  store.read("sensors/position", {0, 0}, {count, 3}, positions.data());
  store.read("sensors/normal", {0, 0}, {count, 3}, normals.data());
  std::vector<measure::SensorPoint> out;
  for (std::size_t s = 0; s < count; ++s)
    out.push_back(
        {names[s], static_cast<int>(indices[s]), {Vec3(&positions[3 * s]), Vec3(&normals[3 * s]), std::nullopt}});
  return out;
}

std::vector<std::uint8_t> done(const Hdf5File& store, std::uint64_t points) {
  std::vector<std::uint8_t> flags(points);
  if (points > 0) store.read("sensors/done", {0}, {points}, flags.data());
  return flags;
}

void write_row(Hdf5File& store, Index s, std::span<const double> F, std::span<const double> error) {
  const Sizes from{at(s), 0}, sizes{1, F.size()};
  store.write("sensors/F", from, sizes, F.data());
  store.write("sensors/error", from, sizes, error.data());
  const std::uint8_t yes = 1;  // last, so that a flag is never ahead of its row
  store.write("sensors/done", {at(s)}, {1}, &yes);
}

void read_row(const Hdf5File& store, Index s, std::span<double> F, std::span<double> error) {
  store.read("sensors/F", {at(s), 0}, {1, F.size()}, F.data());
  store.read("sensors/error", {at(s), 0}, {1, error.size()}, error.data());
}

void write_sums(Hdf5File& store, std::uint64_t points, std::uint64_t elements) {
  if (points == 0) return;
  std::vector<double> F(elements), error(elements), sum(points), bound(points);
  for (std::size_t s = 0; s < points; ++s) {
    read_row(store, static_cast<Index>(s), F, error);
    sum[s] = std::accumulate(F.begin(), F.end(), 0.0);
    bound[s] = std::min(std::accumulate(error.begin(), error.end(), 0.0), 1 + sum[s]);  // true entries add up to <= 1
  }
  store.write("sensors/row_sum", {0}, {points}, sum.data());
  store.write("sensors/row_error", {0}, {points}, bound.data());
}

std::uint64_t bytes(std::uint64_t points, std::uint64_t elements) {
  constexpr std::uint64_t lists = 9 * sizeof(double) + 65;  // and a name
  return points * (2 * elements * sizeof(double) + lists);
}

}  // namespace point_group

}  // namespace interflect::results
