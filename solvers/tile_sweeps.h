#pragma once

#include <optional>

#include "solvers/sweeps.h"
#include "solvers/tile_access.h"

namespace interflect::solvers {

/// Sweeps over a symmetric K that is stored in tiles of its lower triangle, which is read from memory once a sweep.
///
/// Rows are used twice while they are at hand: for what their unknowns receive from those before them, and, when they
/// have their new values, for what they send to those.  What is sent so is what the rows before receive from those
/// after them: on the way back in the same sweep, on the way there in the next.
///
///   on the way there:  from before  sum_J<I K_IJ b_J (new),  from after  up_I = sum_J>I K_JI^T b_J (of the last sweep)
///   on the way back:   from before  sum_J<I K_IJ b_J (old),  from after  up_I = sum_J>I K_JI^T b_J (of this one)
///
/// What is missing from row a after a sweep there (`Sweeps::residual`) is then up_a less what it was before.
/// A few rows at a time, so that they stay in the second-level cache of the threads that share them: one pass sends
/// what the last few have and receives what the next few get.  Sums over a row do not depend on how many these are.
class TileSweeps final : public Sweeps {
 public:
  TileSweeps(const System& system, const TileAccess& tiles, double relaxation, const ColumnMatrix& start,
             const Run& run);
  void forward() override;
  void back() override;

 private:
  /// A few rows of a row of tiles: one part, or several.
  struct Strip {
    Index I, row;  ///< tiles; first row in them
  };
  Index strips() const { return tile_rows() * (tile_size / height_); }
  Strip strip(Index s) const { return {s / (tile_size / height_), s % (tile_size / height_) * height_}; }
  Index tile_rows() const { return x_.cols() / tile_size; }
  void send_all();
  void fetch_diagonal(Index I);
  void sweep_strip(const Strip& strip, bool ascending, ConstColumns from_after);
  void send_and_receive(const std::optional<Strip>& sender, const std::optional<Strip>& receiver);
  void pass_tiles(const std::optional<Strip>& sender, const std::optional<Strip>& receiver, Index begin, Index end,
                  double* lanes);

  const TileAccess& tiles_;
  const Run& run_;
  Index height_ = tile_size;  ///< rows of a strip, a multiple of part_rows
  CacheLines room_[2];
  Eigen::Map<ColumnMatrix> up_,
      sent_;                ///< columns x stride: received from unknowns after, in other rows of tiles; so far
  bool knows_up_ = false;   ///< of the x that there is
  CacheLines diagonal_;     ///< the tile of the strips that are swept, row after row
  Index diagonal_of_ = -1;  ///< row of tiles
  CacheLines lanes_;        ///< of what a strip receives, by task: columns x tile_size x tile_lanes each
  ColumnMatrix received_;   ///< columns x tile_size
};

}  // namespace interflect::solvers
