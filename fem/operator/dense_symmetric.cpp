#include "fem/operator/dense_symmetric.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "core/format.h"
#include "solvers/cache_lines.h"
#include "solvers/tile_product.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace interflect::fem {
namespace {

using solvers::tile_entries, solvers::tile_lanes, solvers::tile_size, solvers::part_rows, solvers::part_entries;
constexpr Index strip_count = 16;  // more would cost vectors of partial sums, fewer would leave processors idle

/// Pages of zeros, large ones where the system has them.
double* zeros(Index count) {
  const std::size_t alignment = std::size_t{2} << 20;
  const std::size_t bytes = (static_cast<std::size_t>(count) * sizeof(double) + alignment - 1) / alignment * alignment;
  void* p = std::aligned_alloc(alignment, bytes);
  if (p == nullptr)
    throw core::InputError("dense operator: no memory for its " + core::format_bytes(static_cast<double>(bytes)) +
                           "; larger elements expected");
#ifdef __linux__
  madvise(p, bytes, MADV_HUGEPAGE);
#endif
  std::memset(p, 0, bytes);
  return static_cast<double*>(p);
}

/// Columns of a part, `count` from `K` on, become rows of `to`, `width` long: in blocks of one cache line to write, and
/// few to read from.
void copy_transposed(const double* K, Index count, Index width, double* to, Index stride) {
  constexpr Index line = 8;
  for (Index j = 0; j < width; j += line) {
    const Index block = std::min(line, width - j);
    for (Index i = 0; i < count; ++i)
      for (Index k = 0; k < block; ++k) to[i * stride + j + k] = K[(j + k) * tile_size + i];
  }
}

}  // namespace

/// A few columns, padded with zeros to whole tiles: tile after tile, in it column after column.
class DenseSymmetric::TiledColumns {
 public:
  TiledColumns(Index tiles, Index columns) : columns_(columns), values_(tiles * columns * tile_size) {}
  const double* tile(Index I) const { return values_.data() + I * columns_ * tile_size; }
  double* tile(Index I) { return values_.data() + I * columns_ * tile_size; }
  Index columns() const { return columns_; }
  void set_zero() { values_.set_zero(); }
  double& operator()(Index row, Index c) { return tile(row / tile_size)[c * tile_size + row % tile_size]; }

 private:
  Index columns_;
  solvers::CacheLines values_;
};

/// What a product needs beside its columns.  A strip of tiles adds to rows of its own and to all before them: it has
/// sums of its own, up to its last row.
struct DenseSymmetric::Room {
  Room(Index tile_rows, std::span<const Strip> strips, Index columns_of_it)
      : columns(columns_of_it), x(tile_rows, columns) {
    for (const Strip& strip : strips) sums.emplace_back(strip.end, columns);
  }
  Index columns;
  TiledColumns x;
  std::vector<TiledColumns> sums;
};

/// One that no other product is using, of as many columns.
std::unique_ptr<DenseSymmetric::Room> DenseSymmetric::take_room(Index columns) const {
  const std::scoped_lock lock(rooms_mutex_);
  for (std::unique_ptr<Room>& room : rooms_)
    if (room->columns == columns) {
      std::swap(room, rooms_.back());
      std::unique_ptr<Room> taken = std::move(rooms_.back());
      rooms_.pop_back();
      return taken;
    }
  return std::make_unique<Room>(tile_rows_, strips_, columns);
}

void DenseSymmetric::give_back(std::unique_ptr<Room> room) const {
  const std::scoped_lock lock(rooms_mutex_);
  rooms_.push_back(std::move(room));
}

void DenseSymmetric::Free::operator()(double* p) const { std::free(p); }

DenseSymmetric::DenseSymmetric(std::vector<double> gram, Index functions)
    : layout_(solvers::Layout::uniform(static_cast<Index>(gram.size()) / functions, functions)),
      areas_(std::move(gram)),
      self_(areas_.size(), 0.0),
      tile_rows_((size() + tile_size - 1) / tile_size) {
  const Index tiles = tile_rows_ * (tile_rows_ + 1) / 2;
  entries_.reset(zeros(std::max<Index>(tiles, 1) * tile_entries));
  errors_ = std::vector<std::atomic<float*>>(static_cast<std::size_t>(tiles));
  for (Index I = 0; I < tile_rows_;) {  // strip s ends where (s + 1) / strip_count of the tiles are passed
    const Index enough = (static_cast<Index>(strips_.size()) + 1) * tiles;
    Index end = I + 1;
    while (end < tile_rows_ && tile_at(end, 0) * strip_count < enough) ++end;
    strips_.push_back({I, end});
    I = end;
  }
}

DenseSymmetric::~DenseSymmetric() {
  for (const auto& errors : errors_) delete[] errors.load();
}

float* DenseSymmetric::error_tile(Index at) {
  std::atomic<float*>& slot = errors_[static_cast<std::size_t>(at)];
  if (float* present = slot.load(std::memory_order_acquire)) return present;
  auto fresh = std::make_unique<float[]>(static_cast<std::size_t>(tile_entries));
  float* present = nullptr;
  if (slot.compare_exchange_strong(present, fresh.get(), std::memory_order_acq_rel)) return fresh.release();
  return present;  // another thread was first
}

void DenseSymmetric::add(Index a, Index b, const ExchangeEntry& entry) {
  const auto [K_ab, error, bound] = entry;
  assert(a >= 0 && a < size() && b >= 0 && b < size() && std::isfinite(K_ab) && std::isfinite(error) && bound >= 0);
  if (a < b) std::swap(a, b);
  const Index I = a / tile_size, J = b / tile_size, i = a % tile_size, j = b % tile_size;
  row_data(I, i, J)[j] = K_ab;
  if (I == J) row_data(I, j, J)[i] = K_ab;
  if (a == b) self_[static_cast<std::size_t>(a)] = K_ab;
  if (error == 0 && errors_[static_cast<std::size_t>(tile_at(I, J))].load(std::memory_order_acquire) == nullptr) return;
  float* errors = error_tile(tile_at(I, J));
  errors[i * tile_size + j] = static_cast<float>(error);
  if (I == J) errors[j * tile_size + i] = static_cast<float>(error);
}

double DenseSymmetric::entry(Index a, Index b) const {
  if (a < b) std::swap(a, b);
  return row_data(a / tile_size, a % tile_size, b / tile_size)[b % tile_size];
}

double DenseSymmetric::entry_standard_error(Index a, Index b) const {
  if (a < b) std::swap(a, b);
  const float* errors =
      errors_[static_cast<std::size_t>(tile_at(a / tile_size, b / tile_size))].load(std::memory_order_acquire);
  return errors == nullptr ? 0.0 : static_cast<double>(errors[a % tile_size * tile_size + b % tile_size]);
}

template <class RowsOf>
void DenseSymmetric::multiply(const RowsOf& rows_of, solvers::ConstColumns b, solvers::Columns out, Run& run) const {
  const Index n = size(), columns = b.cols();
  assert(b.rows() == n && out.rows() == n && out.cols() == columns);
  std::unique_ptr<Room> room = take_room(columns);
  for (Index a = 0; a < n; ++a)
    for (Index c = 0; c < columns; ++c) room->x(a, c) = b(a, c);
  run.threads.for_blocks(strips(), 1, [&](Index s, Index) {
    multiply_strip(strips_[static_cast<std::size_t>(s)], rows_of, room->x, room->sums[static_cast<std::size_t>(s)]);
  });
  run.threads.for_blocks(tile_rows_, 16, [&](Index begin, Index stop) {
    for (Index I = begin; I < stop; ++I) add_sums(I, room->sums, out);
  });
  give_back(std::move(room));
}

template <class RowsOf>
void DenseSymmetric::multiply_strip(const Strip& strip, const RowsOf& rows_of, const TiledColumns& x,
                                    TiledColumns& sums) const {
  const Index columns = x.columns();
  sums.set_zero();
  solvers::CacheLines lanes(columns * tile_size * tile_lanes);
  for (Index I = strip.first; I < strip.end; ++I)
    for (Index row = 0; row < tile_size; row += part_rows) {
      solvers::TileRows of{
          .rows = part_rows, .tiles = 0, .columns = columns, .stride = tile_size, .step = columns * tile_size};
      of.lanes = lanes.data();
      of.z = x.tile(I) + row;
      const auto add = [&](const double* K, Index J, Index tiles) {
        of.receiving = of.sending = K;
        of.x = x.tile(J);
        of.y = sums.tile(J);
        of.tiles = std::min(tiles, I - J);
        if (of.tiles > 0) solvers::add_products(of);
        if (J + tiles <= I) return;
        of.receiving += of.tiles * part_entries;  // that on the diagonal is its own mirror
        of.sending = nullptr;
        of.x = x.tile(I);
        of.tiles = 1;
        solvers::add_products(of);
      };
      rows_of(I, row, add);
      solvers::add_lanes(part_rows, columns, lanes.data(), sums.tile(I) + row, tile_size);
    }
}

/// The rows of out that tile row I has, in the order of the strips.
void DenseSymmetric::add_sums(Index I, std::span<const TiledColumns> sums, solvers::Columns out) const {
  const Index first = I * tile_size, rows = std::min(tile_size, size() - first), columns = out.cols();
  for (Index c = 0; c < columns; ++c) {
    Eigen::Array<double, tile_size, 1> sum = Eigen::Array<double, tile_size, 1>::Zero();
    for (std::size_t s = 0; s < strips_.size(); ++s)
      if (strips_[s].end > I)
        sum += Eigen::Map<const Eigen::Array<double, tile_size, 1>>(sums[s].tile(I) + c * tile_size);
    out.col(c).segment(first, rows) = sum.head(rows);
  }
}

void DenseSymmetric::apply(solvers::ConstColumns b, solvers::Columns out, Run& run) const {
  multiply([&](Index I, Index row, const auto& add) { add(row_data(I, row, 0), 0, I + 1); }, b, out, run);
}

void DenseSymmetric::apply_variances(solvers::ConstColumns b, solvers::Columns out, Run& run) const {
  const auto squared_errors = [&](Index I, Index row, const auto& add) {
    solvers::CacheLines squares(part_entries);
    for (Index J = 0; J <= I; ++J) {
      const float* errors = errors_[static_cast<std::size_t>(tile_at(I, J))].load(std::memory_order_acquire);
      if (errors == nullptr) continue;
      for (Index i = 0; i < part_entries; ++i) {
        const double error = static_cast<double>(errors[row * tile_size + i]);
        squares.data()[i] = error * error;
      }
      add(squares.data(), J, 1);
    }
  };
  multiply(squared_errors, b, out, run);
}

void DenseSymmetric::rows(Index first, Index count, solvers::Columns out) const {
  const Index n = size(), end = first + count;
  assert(first >= 0 && end <= n && out.rows() == count && out.cols() == n);
  for (Index I = first / tile_size; I * tile_size < end; ++I) {
    const Index begin_i = std::max<Index>(first - I * tile_size, 0), end_i = std::min(end - I * tile_size, tile_size);
    double* to = out.row(I * tile_size + begin_i - first).data();
    for (Index J = 0; J <= I; ++J, to += tile_size) {
      const std::size_t width = static_cast<std::size_t>(std::min(tile_size, n - J * tile_size)) * sizeof(double);
      for (Index i = begin_i; i < end_i; ++i)
        std::memcpy(to + (i - begin_i) * out.outerStride(), row_data(I, i, J), width);
    }
    for (Index J = I + 1; J < tile_rows_; ++J, to += tile_size)
      for (Index row = 0; row < std::min(tile_size, n - J * tile_size); row += part_rows)
        copy_transposed(row_data(J, row, I) + begin_i, end_i - begin_i, std::min(part_rows, n - J * tile_size - row),
                        to + row, out.outerStride());
  }
  evaluated_.fetch_add(count, std::memory_order_relaxed);
}

bool DenseSymmetric::has_errors() const {
  return std::any_of(errors_.begin(), errors_.end(), [](const auto& errors) { return errors.load() != nullptr; });
}

std::span<const StoredPair> DenseSymmetric::pairs_of(Index I, Index J, std::span<StoredPair> room) const {
  const float* errors = errors_[static_cast<std::size_t>(tile_at(I, J))].load(std::memory_order_acquire);
  const Index rows = std::min(tile_size, size() - I * tile_size), columns = std::min(tile_size, size() - J * tile_size);
  std::size_t count = 0;
  for (Index i = 0; i < rows; ++i) {
    const double* K = row_data(I, i, J);
    for (Index j = 0; j < (I == J ? i + 1 : columns); ++j) {
      const double error = errors == nullptr ? 0.0 : static_cast<double>(errors[i * tile_size + j]);
      room[count] = {static_cast<std::uint32_t>(J * tile_size + j), static_cast<std::uint32_t>(I * tile_size + i), K[j],
                     error};
      count += K[j] != 0 || error != 0;
    }
  }
  return room.first(count);
}

void DenseSymmetric::visit(Index strip, const Visit& visit) const {
  const auto [first, end] = strips_[static_cast<std::size_t>(strip)];
  std::vector<StoredPair> room(static_cast<std::size_t>(tile_entries) + 1);  // one is written before it counts
  for (Index I = first; I < end; ++I)
    for (Index J = 0; J <= I; ++J)
      if (const auto pairs = pairs_of(I, J, room); !pairs.empty()) visit(pairs);
}

void DenseSymmetric::change(const NewEntry& entry, Run& run) {
  run.threads.for_blocks(strips(), 1, [&](Index strip, Index) {
    visit(strip, [&](std::span<const StoredPair> pairs) {
      const Index I = Index{pairs.front().b} / tile_size, J = Index{pairs.front().a} / tile_size;
      for (const StoredPair& pair : pairs) {
        const Index i = Index{pair.b} - I * tile_size, j = Index{pair.a} - J * tile_size;
        const double K_ab = row_data(I, i, J)[j] = entry(pair);
        if (I == J) row_data(I, j, J)[i] = K_ab;
      }
    });
  });
  for (std::size_t a = 0; a < self_.size(); ++a) self_[a] = this->entry(static_cast<Index>(a), static_cast<Index>(a));
}

std::unique_ptr<SymmetricOperator> DenseSymmetric::alike(std::vector<double> areas, const Fill& fill, Run&) const {
  auto other = std::make_unique<DenseSymmetric>(std::move(areas));
  fill(*other);
  return other;
}

double DenseSymmetric::bytes() const {
  const auto tiles = static_cast<double>(errors_.size());
  const auto with_errors = static_cast<double>(
      std::count_if(errors_.begin(), errors_.end(), [](const auto& e) { return e.load() != nullptr; }));
  return static_cast<double>(tile_entries) * (tiles * sizeof(double) + with_errors * sizeof(float));
}

}  // namespace interflect::fem
