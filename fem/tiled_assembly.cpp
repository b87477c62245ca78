#include "fem/tiled_assembly.h"

#include <algorithm>
#include <mutex>

#include "core/estimate.h"
#include "fem/assembly.h"

namespace interflect::fem {

namespace {

double error_of(const ExchangeEntry& entry) { return entry.bound + normal_95 * entry.standard_error; }

/// Which elements a tile holds.
struct Range {
  Index first, count;
  bool holds(Index a) const { return a >= first && a < first + count; }
};

struct Tile {
  Index I, J;
  Range rows, columns;
};

std::vector<Tile> tiles_of(Index n, Index size) {
  const Index across = (n + size - 1) / size;
  const auto range = [&](Index I) { return Range{I * size, std::min(size, n - I * size)}; };
  std::vector<Tile> tiles;
  for (Index I = 0; I < across; ++I)
    for (Index J = I; J < across; ++J) tiles.push_back({I, J, range(I), range(J)});
  return tiles;
}

/// Entries of one tile, as they come.
struct TileSink final : ExchangeSink {
  explicit TileSink(const Tile& of) : tile(of), K(static_cast<std::size_t>(of.rows.count * of.columns.count), 0), error(K) {}

  void add(Index a, Index b, const ExchangeEntry& entry) override {
    set(a, b, entry);
    if (tile.I == tile.J) set(b, a, entry);
  }
  void set(Index a, Index b, const ExchangeEntry& entry) {
    const auto at = static_cast<std::size_t>((a - tile.rows.first) * tile.columns.count + b - tile.columns.first);
    K[at] = entry.K;
    error[at] = error_of(entry);
  }

  Tile tile;
  std::vector<double> K, error;
};

/// All entries, for methods that cannot be asked for a tile.
class WholeSink final : public ExchangeSink {
 public:
  explicit WholeSink(Index n) : n_(n), K_(static_cast<std::size_t>(n * n), 0), error_(static_cast<std::size_t>(n * n), 0) {}
  void add(Index a, Index b, const ExchangeEntry& entry) override {
    for (const auto at : {static_cast<std::size_t>(a * n_ + b), static_cast<std::size_t>(b * n_ + a)}) {
      K_[at] = entry.K;
      error_[at] = static_cast<float>(error_of(entry));
    }
  }
  void copy_to(TileSink& sink, const Tile& tile) const {
    for (Index a = 0, at = 0; a < tile.rows.count; ++a)
      for (Index b = 0; b < tile.columns.count; ++b, ++at) {
        const auto from = static_cast<std::size_t>((tile.rows.first + a) * n_ + tile.columns.first + b);
        sink.K[static_cast<std::size_t>(at)] = K_[from];
        sink.error[static_cast<std::size_t>(at)] = double{error_[from]};
      }
  }

 private:
  Index n_;
  std::vector<double> K_;
  std::vector<float> error_;
};

class TiledAssembly final : public RowAssembly {
 public:
  TiledAssembly(std::span<const scene::SurfacePatch> patches, TileStore& store, Run& run)
      : patches_(patches), store_(store), run_(run), tiles_(tiles_of(static_cast<Index>(patches.size()), store.tile_size())) {}

  void everything(const FormFactorMethod& method) override {
    if (method.granularity() != FormFactorMethod::Granularity::pair) return whole(method);
    std::vector<Tile> missing;
    for (const Tile& tile : tiles_)
      if (!store_.is_done(tile.I, tile.J)) missing.push_back(tile);
    for_tiles("form factors", missing, [&](const Tile& tile) {
      TileSink sink(tile);
      count(method.exchange(block(tile.rows), block(tile.columns), sink, run_));
      store_.write(tile.I, tile.J, sink.K, sink.error);
    });
  }

  /// These rows and columns once more; the rest of their tiles stays.
  void again(const FormFactorMethod& method, std::span<const Index> rows) override {
    const auto held = [&](const Range& range) {
      std::vector<Index> out;
      std::copy_if(rows.begin(), rows.end(), std::back_inserter(out), [&](Index a) { return range.holds(a); });
      return out;
    };
    std::vector<Tile> touched;
    for (const Tile& tile : tiles_)
      if (!held(tile.rows).empty() || !held(tile.columns).empty()) touched.push_back(tile);
    for_tiles("form factors, again", touched, [&](const Tile& tile) {
      TileSink sink(tile);
      store_.read(tile.I, tile.J, sink.K, sink.error);
      for (const Index a : held(tile.rows)) count(method.exchange({patches_, a, 1}, block(tile.columns), sink, run_));
      for (const Index b : held(tile.columns)) count(method.exchange(block(tile.rows), {patches_, b, 1}, sink, run_));
      store_.write(tile.I, tile.J, sink.K, sink.error);
    });
  }

  /// In the order of the tiles: the same for any number of threads, and for one run or several.
  std::vector<double> row_errors() const override {
    std::vector<double> sums(patches_.size(), 0);
    for (const Tile& tile : tiles_) {
      TileSink t(tile);
      store_.read(tile.I, tile.J, t.K, t.error);
      for (Index a = 0, at = 0; a < tile.rows.count; ++a)
        for (Index b = 0; b < tile.columns.count; ++b, ++at) {
          const double error = t.error[static_cast<std::size_t>(at)];
          sums[static_cast<std::size_t>(tile.rows.first + a)] += error;
          if (tile.I != tile.J) sums[static_cast<std::size_t>(tile.columns.first + b)] += error;
        }
    }
    for (std::size_t a = 0; a < sums.size(); ++a) sums[a] /= patches_[a].area;
    return sums;
  }

  PairCounts counts() const override { return counts_; }

 private:
  ElementBlock block(const Range& range) const { return {patches_, range.first, range.count}; }
  void count(const PairCounts& counts) {
    const std::scoped_lock lock(mutex_);
    counts_ += counts;
  }
  template <class Work>
  void for_tiles(const char* what, const std::vector<Tile>& tiles, const Work& work) {
    core::Progress::Stage stage(run_.progress, what, static_cast<std::uint64_t>(tiles.size()));
    run_.threads.for_blocks(static_cast<Index>(tiles.size()), 1, [&](Index k, Index) {
      run_.throw_if_stopped("form factors");
      work(tiles[static_cast<std::size_t>(k)]);
      stage.advance(1);
    });
  }
  void whole(const FormFactorMethod& method) {
    WholeSink sink(static_cast<Index>(patches_.size()));
    count(assemble(method, patches_, sink, run_));
    for (const Tile& tile : tiles_) {
      TileSink part(tile);
      sink.copy_to(part, tile);
      store_.write(tile.I, tile.J, part.K, part.error);
    }
  }

  std::span<const scene::SurfacePatch> patches_;
  TileStore& store_;
  Run& run_;
  std::vector<Tile> tiles_;
  std::mutex mutex_;
  PairCounts counts_;
};

}  // namespace

ToleranceReport assemble_tiles(const MethodMaker& make, double tolerance, std::span<const scene::SurfacePatch> patches, TileStore& store,
                               Run& run) {
  TiledAssembly assembly(patches, store, run);
  return until_rows_meet(tolerance, make, assembly);
}

}  // namespace interflect::fem
