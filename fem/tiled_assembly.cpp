#include "fem/tiled_assembly.h"

#include <algorithm>
#include <mutex>

#include "core/estimate.h"
#include "core/format.h"
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
  explicit TileSink(const Tile& of)
      : tile(of), K(static_cast<std::size_t>(of.rows.count * of.columns.count), 0), error(K) {}

  void add(Index a, Index b, const ExchangeEntry& entry) override {
    set(a, b, entry);
    if (tile.I == tile.J) set(b, a, entry);
  }
  void set(Index a, Index b, const ExchangeEntry& entry) {
    K[at(a, b)] = entry.K;
    error[at(a, b)] = error_of(entry);
  }
  double error_at(Index a, Index b) const { return error[at(a, b)]; }
  std::size_t at(Index a, Index b) const {
    return static_cast<std::size_t>((a - tile.rows.first) * tile.columns.count + b - tile.columns.first);
  }

  Tile tile;
  std::vector<double> K, error;
};

/// All entries, for methods that cannot be asked for a tile.
class WholeSink final : public ExchangeSink {
 public:
  explicit WholeSink(Index n)
      : n_(n), K_(static_cast<std::size_t>(n * n), 0), error_(static_cast<std::size_t>(n * n), 0) {}
  void add(Index a, Index b, const ExchangeEntry& entry) override {
    for (const auto at : {static_cast<std::size_t>(a * n_ + b), static_cast<std::size_t>(b * n_ + a)}) {
      K_[at] = entry.K;
      error_[at] = static_cast<float>(error_of(entry));
    }
  }
  void copy_to(TileSink& sink, const Tile& tile) const {
    for (Index a = 0, at = 0; a < tile.rows.count; ++a)
      for (Index b = 0; b < tile.columns.count; ++b, ++at) {
        if (tile.rows.first + a >= n_ || tile.columns.first + b >= n_) continue;
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
  TiledAssembly(std::span<const scene::SurfacePatch> patches, double tolerance, TileStore& store, Run& run,
                std::span<const CoveredPair> covered)
      : patches_(patches),
        tolerance_(tolerance),
        store_(store),
        run_(run),
        covered_(covered),
        tiles_(tiles_of(static_cast<Index>(patches.size() + 2 * covered.size()), store.tile_size())) {}

  void everything(const FormFactorMethod& method) override {
    if (method.granularity() != FormFactorMethod::Granularity::pair) return whole(method);
    std::vector<Tile> missing;
    for (const Tile& tile : tiles_)
      if (!store_.is_done(tile.I, tile.J)) missing.push_back(tile);
    const auto pairs = [&](const Tile& tile) {
      return std::max<Index>(
          1, tile.I == tile.J ? tile.rows.count * (tile.rows.count - 1) / 2 : tile.rows.count * tile.columns.count);
    };
    for_tiles("form factors", missing, pairs, [&](const Tile& tile) {
      TileSink sink(tile);
      count(method.exchange(block(tile.rows), block(tile.columns), sink, run_));
      add_covered(sink);
      store_.write(tile.I, tile.J, sink.K, sink.error);
    });
  }

  /// Of these rows and columns what they err by most, once more; the rest of their tiles stays.
  void again(const FormFactorMethod& method, std::span<const Index> rows) override {
    const auto held = [&](const Range& range) {
      std::vector<Index> out;
      std::copy_if(rows.begin(), rows.end(), std::back_inserter(out), [&](Index a) { return range.holds(a); });
      return out;
    };
    const auto pairs = [&](const Tile& tile) {
      return std::ssize(held(tile.rows)) * tile.columns.count + std::ssize(held(tile.columns)) * tile.rows.count;
    };
    std::vector<Tile> touched;
    for (const Tile& tile : tiles_)
      if (pairs(tile) > 0) touched.push_back(tile);
    ++passes_;
    for_tiles(core::format("form factors, pass %d", passes_ + 1), touched, pairs, [&](const Tile& tile) {
      TileSink sink(tile);
      store_.read(tile.I, tile.J, sink.K, sink.error);
      const TileSink before = sink;
      const auto errs = [&](Index of, Index a, Index b) { return before.error_at(a, b) > negligible(of); };
      for (const Index a : held(tile.rows))
        for_runs(
            tile.columns, [&](Index b) { return errs(a, a, b); },
            [&](const Range& run) {
              count(method.exchange({patches_, a, 1}, block(run), sink, run_));
            });
      for (const Index b : held(tile.columns))
        for_runs(
            tile.rows, [&](Index a) { return errs(b, a, b); },
            [&](const Range& run) {
              count(method.exchange(block(run), {patches_, b, 1}, sink, run_));
            });
      store_.write(tile.I, tile.J, sink.K, sink.error);
    });
  }

  /// In the order of the tiles: the same for any number of threads, and for one run or several.
  std::vector<double> row_errors() const override {
    std::vector<double> sums(patches_.size() + 2 * covered_.size(), 0);
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
    for (std::size_t a = 0; a < patches_.size(); ++a) sums[a] /= patches_[a].area;  // the others have none
    return sums;
  }

  PairCounts counts() const override { return counts_; }

 private:
  /// Those of them that the method knows.
  ElementBlock block(const Range& range) const {
    const auto known = static_cast<Index>(patches_.size());
    return {patches_, range.first, std::clamp<Index>(known - range.first, 0, range.count)};
  }
  double negligible(Index a) const {
    return negligible_error(tolerance_, patches_[static_cast<std::size_t>(a)].area, std::ssize(patches_));
  }
  /// Runs of neighbours that are wanted.
  template <class Wanted, class Work>
  static void for_runs(const Range& range, const Wanted& wanted, const Work& work) {
    for (Index a = range.first, end = range.first + range.count; a < end; ++a) {
      const Index first = a;
      while (a < end && wanted(a)) ++a;
      if (a > first) work(Range{first, a - first});
    }
  }
  void add_covered(TileSink& sink) const {
    for (const CoveredPair& pair : covered_)
      if (sink.tile.rows.holds(pair.a) && sink.tile.columns.holds(pair.b)) sink.add(pair.a, pair.b, {pair.K});
  }
  void count(const PairCounts& counts) {
    const std::scoped_lock lock(mutex_);
    counts_ += counts;
  }
  /// @param pairs  of a tile, that are to be computed: by them the time left is told
  template <class Pairs, class Work>
  void for_tiles(const std::string& what, const std::vector<Tile>& tiles, const Pairs& pairs, const Work& work) {
    std::uint64_t all = 0;
    for (const Tile& tile : tiles) all += static_cast<std::uint64_t>(pairs(tile));
    core::Progress::Stage stage(run_.progress, what, all);
    run_.threads.for_blocks(static_cast<Index>(tiles.size()), 1, [&](Index k, Index) {
      run_.throw_if_stopped("form factors");
      const Tile& tile = tiles[static_cast<std::size_t>(k)];
      work(tile);
      stage.advance(static_cast<std::uint64_t>(pairs(tile)));
    });
  }
  void whole(const FormFactorMethod& method) {
    WholeSink sink(static_cast<Index>(patches_.size()));
    count(assemble(method, patches_, sink, run_));
    for (const Tile& tile : tiles_) {
      TileSink part(tile);
      sink.copy_to(part, tile);
      add_covered(part);
      store_.write(tile.I, tile.J, part.K, part.error);
    }
  }

  std::span<const scene::SurfacePatch> patches_;
  double tolerance_;  ///< of rows
  TileStore& store_;
  Run& run_;
  std::span<const CoveredPair> covered_;
  std::vector<Tile> tiles_;
  int passes_ = 0;  ///< of some rows again
  std::mutex mutex_;
  PairCounts counts_;
};

}  // namespace

ToleranceReport assemble_tiles(const MethodMaker& make, double tolerance, std::span<const scene::SurfacePatch> patches,
                               TileStore& store, Run& run, std::span<const CoveredPair> covered) {
  TiledAssembly assembly(patches, tolerance, store, run, covered);
  return until_rows_meet(tolerance, make, assembly);
}

}  // namespace interflect::fem
