#include "results/factor_store.h"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/format.h"
#include "results/atomic_file.h"
#include "results/factor_store_layout.h"

namespace interflect::results {

namespace {

using namespace store_layout;

std::filesystem::path partial_of(const std::filesystem::path& file) { return file.string() + ".partial"; }

/// The least float that is not below x, so that a bound stays one.
float rounded_up(double x) {
  const float nearest = static_cast<float>(x);
  return static_cast<double>(nearest) < x ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

std::vector<double> flat(const std::vector<Vec3>& points) {
  std::vector<double> out;
  out.reserve(3 * points.size());
  for (const Vec3& x : points) out.insert(out.end(), {x.x(), x.y(), x.z()});
  return out;
}

/// @param padded  elements, up to whole tiles
Hdf5File::Room room_for(const FactorElements& elements, std::uint64_t padded,
                        std::span<const measure::SensorPoint> points) {
  std::size_t width = 1, point_width = 1;
  for (const std::string& name : elements.name) width = std::max(width, name.size());
  for (const measure::SensorPoint& point : points) point_width = std::max(point_width, point.sensor.size());
  constexpr std::uint64_t structure = 1 << 20, lists = 12 * sizeof(double);
  const std::uint64_t at_once =
      structure + elements.area.size() * (lists + width) + points.size() * (lists + point_width);
  return {at_once + padded * padded * (sizeof(double) + sizeof(float)) +
              point_group::bytes(points.size(), elements.area.size()),
          at_once};
}

}  // namespace

Hdf5File FactorStoreWriter::begin(const std::filesystem::path& file, const FactorElements& elements,
                                  const FactorStoreKey& key, Index tile, std::span<const measure::SensorPoint> points) {
  const std::uint64_t n = size_of(elements.size()), t = size_of(tile), across = (n + t - 1) / t;
  Hdf5File store = Hdf5File::create(file, room_for(elements, across * t, points));
  store.write_note("format", format_name);
  store.write_note("digest", key.digest);
  store.write_note("settings", key.settings);
  store.write_count("tile", t);
  for (const char* name : {"area", "row_sum", "row_error"}) store.make_doubles(name, {n});
  for (const char* name : {"normal", "centroid"}) store.make_doubles(name, {n, 3});
  store.make_bytes("tile_done", {across, across});
  const Sizes tiles = n > 0 ? Sizes{t, t} : Sizes{};
  store.make_doubles("K", {n, n}, tiles);
  store.make_floats("K_error", {n, n}, tiles);
  store.write("area", {0}, {n}, elements.area.data());
  store.write("normal", {0, 0}, {n, 3}, flat(elements.normal).data());
  store.write("centroid", {0, 0}, {n, 3}, flat(elements.centroid).data());
  store.write_texts("name", elements.name);
  if (!elements.environment.empty()) {
    for (const char* name : {"environment", "environment_error"}) store.make_doubles(name, {n});
    store.write("environment", {0}, {n}, elements.environment.data());
    store.write("environment_error", {0}, {n}, elements.environment_error.data());
  }
  if (!elements.closure_change.empty()) {
    store.make_doubles("closure_change", {n});
    store.write("closure_change", {0}, {n}, elements.closure_change.data());
  }
  point_group::make(store, points, n);
  store.flush();
  return store;
}

Index usual_tile(Index elements) { return std::clamp<Index>((elements + 31) / 32, 16, 512); }

FactorStoreWriter::FactorStoreWriter(std::filesystem::path file, const FactorElements& elements,
                                     const FactorStoreKey& key, Index tile,
                                     std::span<const measure::SensorPoint> points)
    : file_(std::move(file)), partial_(partial_of(file_)), size_(elements.size()), area_(elements.area) {
  const std::size_t n = elements.area.size();
  if ((!elements.environment.empty() && elements.environment.size() != n) ||
      elements.environment_error.size() != elements.environment.size() ||
      (!elements.closure_change.empty() && elements.closure_change.size() != n) || elements.normal.size() != n ||
      elements.centroid.size() != n || elements.name.size() != n || tile < 0)
    throw core::PreconditionError("FactorStoreWriter: one entry per element in each list, and a tile of 0 or more");
  if (std::error_code error; file_.filename().empty() || std::filesystem::is_directory(file_, error))
    throw core::InputError(file_.string(), "cannot be written: Is a directory");
  if (std::error_code error; !std::filesystem::exists(partial_, error)) {
    // Not under its name before it can be opened again.
    const std::filesystem::path unborn = partial_.string() + ".new";
    try {
      const Index wanted = tile > 0 ? tile : usual_tile(size_);
      begin(unborn, elements, key, std::min(wanted, std::max<Index>(size_, 1)), points);
      keep_as(unborn, partial_);
    } catch (const core::InputError&) {
      std::filesystem::remove(unborn, error);
      throw;
    }
  }
  go_on(elements, key, points);
}

void FactorStoreWriter::go_on(const FactorElements& elements, const FactorStoreKey& key,
                              std::span<const measure::SensorPoint> points) try {
  store_ = std::make_unique<Hdf5File>(Hdf5File::open(partial_, Hdf5File::Access::change));
  require_store(*store_);
  if (const std::uint64_t begun = element_count(*store_); begun != size_of(elements.size()))
    throw core::InputError(
        partial_.string(),
        core::format("it was begun with %llu elements, and this run has %llu (remove it to begin "
                     "anew, or repeat the options to go on)",
                     static_cast<unsigned long long>(begun), static_cast<unsigned long long>(elements.size())));
  require_digest(*store_, store_->note("digest"), key.digest);
  if (store_->note("settings") != key.settings)
    throw core::InputError(partial_.string(),
                           "it was begun with other settings (remove it to begin anew, or repeat them to go on)");
  const std::uint64_t n = size_of(elements.size());
  const bool same_repair = read_if_there(*store_, "environment", n) == elements.environment &&
                           read_if_there(*store_, "environment_error", n) == elements.environment_error &&
                           read_if_there(*store_, "closure_change", n) == elements.closure_change;
  if (read_doubles(*store_, "area", n) != elements.area || store_->texts("name") != elements.name || !same_repair)
    throw core::InputError(partial_.string(), "its elements are others than those of this run");
  if (!same_points(point_group::points(*store_, n), points))
    throw core::InputError(partial_.string(), "it was begun with other sensors (remove it to begin anew)");
  tile_ = tile_size(*store_, n);
  across_ = (size_ + tile_ - 1) / tile_;
  require_sizes(*store_, "K", {n, n});
  require_sizes(*store_, "K_error", {n, n});
  done_ = read_done(*store_, across_);
  points_done_ = point_group::done(*store_, points.size());
} catch (const DamagedFile&) {
  throw core::InputError(partial_.string(), "it is damaged or cut short: remove it to begin anew");
}

bool FactorStoreWriter::is_done(Index I, Index J) const {
  const std::lock_guard lock(mutex_);
  return done_[static_cast<std::size_t>(I * across_ + J)] != 0;
}

Index FactorStoreWriter::done() const {
  const std::lock_guard lock(mutex_);
  return std::count_if(done_.begin(), done_.end(), [](std::uint8_t flag) { return flag != 0; });
}

void FactorStoreWriter::write(Index I, Index J, std::span<const double> K, std::span<const double> error) {
  if (I < 0 || I > J || J >= across_) throw core::PreconditionError("FactorStoreWriter: no such tile");
  const Sizes from{size_of(first(I)), size_of(first(J))}, sizes{size_of(count(I)), size_of(count(J))};
  if (K.size() != sizes[0] * sizes[1] || error.size() != K.size())
    throw core::PreconditionError("FactorStoreWriter: a number per pair of the tile expected");
  bool zero = true;
  std::vector<float> bound(error.size());
  for (std::size_t k = 0; k < K.size(); ++k) {
    if (!std::isfinite(K[k]) || !(error[k] >= 0)) throw core::PreconditionError("FactorStoreWriter: not a number");
    bound[k] = rounded_up(error[k]);
    zero = zero && K[k] == 0 && bound[k] == 0;
  }
  const std::lock_guard lock(mutex_);
  if (!store_) throw core::PreconditionError("FactorStoreWriter: it is finished");
  if (!zero) {  // a hole of the file reads as zeros
    store_->write("K", from, sizes, K.data());
    store_->write("K_error", from, sizes, bound.data());
  }
  // Last, so that a flag is never ahead of its tile.
  const std::uint8_t yes = 1;
  store_->write("tile_done", {size_of(I), size_of(J)}, {1, 1}, &yes);
  done_[static_cast<std::size_t>(I * across_ + J)] = yes;
}

void FactorStoreWriter::read(Index I, Index J, std::span<double> K, std::span<double> error) const {
  const Sizes from{size_of(first(I)), size_of(first(J))}, sizes{size_of(count(I)), size_of(count(J))};
  if (I > J || K.size() != sizes[0] * sizes[1] || error.size() != K.size())
    throw core::PreconditionError("FactorStoreWriter: a number per pair of the tile expected");
  std::vector<float> bound(error.size());
  const std::lock_guard lock(mutex_);
  if (!store_) throw core::PreconditionError("FactorStoreWriter: it is finished");
  store_->read("K", from, sizes, K.data());
  store_->read("K_error", from, sizes, bound.data());
  std::copy(bound.begin(), bound.end(), error.begin());
}

bool FactorStoreWriter::is_point_done(Index s) const {
  const std::lock_guard lock(mutex_);
  return points_done_[size_of(s)] != 0;
}

void FactorStoreWriter::write_point(Index s, std::span<const double> F, std::span<const double> error) {
  const bool fits = s >= 0 && size_of(s) < points_done_.size() && F.size() <= area_.size() && error.size() == F.size();
  if (!fits) throw core::PreconditionError("FactorStoreWriter: no such point, or more numbers than elements");
  for (std::size_t j = 0; j < F.size(); ++j)
    if (!std::isfinite(F[j]) || !(error[j] >= 0)) throw core::PreconditionError("FactorStoreWriter: not a number");
  const std::lock_guard lock(mutex_);
  if (!store_) throw core::PreconditionError("FactorStoreWriter: it is finished");
  point_group::write_row(*store_, s, F, error);
  points_done_[size_of(s)] = 1;
}

void FactorStoreWriter::write_row_sums() {
  std::vector<double> sum(area_.size()), bound(area_.size()), K;
  std::vector<float> error;
  for (Index I = 0; I < across_; ++I)
    for (Index J = I; J < across_; ++J) {
      const std::size_t rows = size_of(count(I)), columns = size_of(count(J)), i0 = size_of(first(I)),
                        j0 = size_of(first(J));
      K.resize(rows * columns);
      error.resize(rows * columns);
      store_->read("K", {i0, j0}, {rows, columns}, K.data());
      store_->read("K_error", {i0, j0}, {rows, columns}, error.data());
      for (std::size_t a = 0; a < rows; ++a)
        for (std::size_t b = 0; b < columns; ++b) {
          const std::size_t k = a * columns + b;
          sum[i0 + a] += K[k];
          bound[i0 + a] += static_cast<double>(error[k]);
          if (I == J) continue;
          sum[j0 + b] += K[k];
          bound[j0 + b] += static_cast<double>(error[k]);
        }
    }
  for (std::size_t i = 0; i < area_.size(); ++i) sum[i] /= area_[i], bound[i] /= area_[i];
  store_->write("row_sum", {0}, {sum.size()}, sum.data());
  store_->write("row_error", {0}, {bound.size()}, bound.data());
}

void FactorStoreWriter::finish() {
  if (done() != tiles()) throw core::PreconditionError("FactorStoreWriter: a tile is missing");
  const std::lock_guard lock(mutex_);
  if (!store_) throw core::PreconditionError("FactorStoreWriter: it is finished");
  if (std::find(points_done_.begin(), points_done_.end(), 0) != points_done_.end())
    throw core::PreconditionError("FactorStoreWriter: a point is missing");
  write_row_sums();
  point_group::write_sums(*store_, points_done_.size(), area_.size());
  store_->flush();
  store_.reset();
  keep_as(partial_, file_);
}

double begun_bytes(const std::filesystem::path& file) {
  struct ::stat status {};
  constexpr double block = 512;
  return ::stat(partial_of(file).c_str(), &status) == 0 ? block * static_cast<double>(status.st_blocks) : 0;
}

double factor_store_bytes(std::uint64_t elements, std::uint64_t points) {
  const auto n = static_cast<double>(elements),
             t = std::min(n, static_cast<double>(usual_tile(static_cast<Index>(elements))));
  const double across = elements > 0 ? std::ceil(n / t) : 0;
  constexpr double per_pair = sizeof(double) + sizeof(float), lists = 12 * sizeof(double) + 65, structure = 1 << 20;
  return 0.5 * per_pair * across * (across + 1) * t * t + lists * n +
         static_cast<double>(point_group::bytes(points, elements)) + structure;
}

}  // namespace interflect::results
