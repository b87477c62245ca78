#include <algorithm>
#include <memory>

#include "core/error.h"
#include "results/factor_store.h"
#include "results/factor_store_layout.h"

namespace interflect::results {

using namespace store_layout;

FactorStore::FactorStore(const std::filesystem::path& file) : store_(Hdf5File::open(file, Hdf5File::Access::read)) {
  require_store(store_);
  key_ = {store_.note("digest"), store_.note("settings")};
  const std::uint64_t n = element_count(store_);
  elements_.area = read_doubles(store_, "area", n);
  elements_.normal = read_points(store_, "normal", n);
  elements_.centroid = read_points(store_, "centroid", n);
  elements_.name = store_.texts("name");
  require_sizes(store_, "name", {n});
  elements_.environment = read_if_there(store_, "environment", n);
  elements_.environment_error = read_if_there(store_, "environment_error", n);
  elements_.closure_change = read_if_there(store_, "closure_change", n);
  row_sum_ = read_doubles(store_, "row_sum", n);
  row_error_ = read_doubles(store_, "row_error", n);
  require_sizes(store_, "K", {n, n});
  require_sizes(store_, "K_error", {n, n});
  tile_ = tile_size(store_, n);
  const Index across = (size() + tile_ - 1) / tile_;
  const std::vector<std::uint8_t> done = read_done(store_, across);
  for (Index I = 0; I < across; ++I)
    for (Index J = I; J < across; ++J)
      if (done[size_of(I * across + J)] == 0)
        throw core::InputError(file.string(), "it is not finished: the run that computes it can be repeated to go on");
  points_ = point_group::points(store_, n);
}

void FactorStore::require_geometry(const std::string& digest) const { require_digest(store_, key_.digest, digest); }

/// Rows first .. first + count, all within the tiles I: the tiles to the right as they lie, those above the diagonal
/// turned.
void FactorStore::read_tile_rows(Index I, Index first, Index count, double* K, double* error) const {
  const std::size_t n = size_of(size());
  std::vector<double> part;
  std::vector<float> part_error;
  for (Index j0 = 0; j0 < size(); j0 += tile_) {
    const Index columns = std::min(tile_, size() - j0);
    const bool turned = j0 < I * tile_;
    const Sizes from = turned ? Sizes{size_of(j0), size_of(first)} : Sizes{size_of(first), size_of(j0)};
    const Sizes sizes = turned ? Sizes{size_of(columns), size_of(count)} : Sizes{size_of(count), size_of(columns)};
    part.resize(sizes[0] * sizes[1]);
    part_error.resize(part.size());
    store_.read("K", from, sizes, part.data());
    store_.read("K_error", from, sizes, part_error.data());
    for (std::size_t a = 0; a < size_of(count); ++a)
      for (std::size_t b = 0; b < size_of(columns); ++b) {
        const std::size_t k = turned ? b * sizes[1] + a : a * sizes[1] + b;
        K[a * n + size_of(j0) + b] = part[k];
        error[a * n + size_of(j0) + b] = static_cast<double>(part_error[k]);
      }
  }
}

void FactorStore::read_rows(Index first, Index count, std::span<double> K, std::span<double> error) const {
  if (first < 0 || count < 0 || first + count > size() || K.size() != size_of(count) * size_of(size()) ||
      error.size() != K.size())
    throw core::PreconditionError("FactorStore: rows that are there, and space for them");
  for (Index i = first; i < first + count;) {
    const Index I = i / tile_, end = std::min(first + count, (I + 1) * tile_);
    const std::size_t at = size_of(i - first) * size_of(size());
    read_tile_rows(I, i, end - i, K.data() + at, error.data() + at);
    i = end;
  }
}

FactorRows FactorStore::rows() const {
  struct Held {
    Index tile = -1;
    std::vector<double> K, error;
  };
  return [this, held = std::make_shared<Held>()](Index i, std::span<double> F, std::span<double> error) {
    const std::size_t n = size_of(size());
    if (const Index I = i / tile_; held->tile != I) {
      const Index count = std::min(tile_, size() - I * tile_);
      held->tile = -1;  // should reading fail
      held->K.resize(size_of(count) * n);
      held->error.resize(held->K.size());
      read_rows(I * tile_, count, held->K, held->error);
      held->tile = I;
    }
    const std::size_t at = size_of(i % tile_) * n;
    const double area = elements_.area[size_of(i)];
    for (std::size_t j = 0; j < n; ++j) F[j] = held->K[at + j] / area, error[j] = held->error[at + j] / area;
  };
}

PointFactors FactorStore::point_factors() const {
  return {points_, [this](Index s, std::span<double> F, std::span<double> error) {
            point_group::read_row(store_, s, F, error);
          }};
}

}  // namespace interflect::results
