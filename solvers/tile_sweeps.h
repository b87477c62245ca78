#pragma once

#include <optional>

#include "core/attendance.h"
#include "core/team.h"
#include "solvers/sweeps.h"
#include "solvers/tile_access.h"
#include "solvers/tile_product.h"

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
///
/// A strip, a few rows, at a time, so that it stays in the second-level cache: one pass sends what one strip has and
/// receives what another gets.  Threads have columns of their own, the same for some strips.  One of them makes the new
/// values, a strip ahead of the passes, so that none waits for another, and has fewer columns for it.  The passes that
/// go on beside it neither need nor give what passes between a strip and the one after it.  Within a row of tiles its
/// tile on the diagonal tells that; of two strips in different rows of tiles the thread that makes the new values sees
/// to the tile between them, the `near` one.
class TileSweeps final : public Sweeps {
 public:
  TileSweeps(const System& system, const TileAccess& tiles, double relaxation, const ColumnMatrix& start,
             const Run& run);
  void forward() override;
  void back() override;

 private:
  /// A part of a row of tiles.
  struct Strip {
    Index I, row;  ///< tiles; first row in them
  };
  using OneStrip = std::optional<Strip>;
  /// What a sweep is: the order of the strips, and what they receive from unknowns after them.
  struct Way {
    bool ascending;
    ConstColumns from_after;
  };
  /// Sums over a row are cut, so that members have some pieces each, in a way that does not depend on their number.
  struct Pieces {
    Index tiles, pieces;
    Index begin(Index piece) const { return tiles * piece / pieces; }
  };
  struct Pass {
    OneStrip sender, receiver, next;
    Index sends, receives;   ///< tiles, from the first column on
    Pieces cut, cut_before;  ///< of what is received; in the pass before
  };
  struct Products {
    Index begin, end;  ///< tiles
    OneStrip receiver, sender;
    const double* after;  ///< what is received next, if it does not lie behind
  };

  /// How far those have come who work on a sweep.
  struct Steps {
    core::StepCount renewed;              ///< strips
    std::vector<core::StepCount> passed;  ///< passes, by member
    double wait_for_all(Index passes) const;
  };

  Index tile_rows() const { return x_.cols() / tile_size; }
  Index strips() const { return tile_rows() * (tile_size / part_rows); }
  OneStrip strip(Index s, bool ascending) const;
  bool has_near(const Strip& strip) const { return strip.row == 0 && strip.I > 0; }
  Pieces pieces(const OneStrip& receiver) const;
  Pass pass_of(const OneStrip& sender, Index s, const Way& way) const;
  double* sums(const Strip& strip, Index piece);

  void send_all();
  void sweep_all(const Way& way);
  double sweep_by(unsigned member, const Way& way, Steps& steps);
  void renew(const Strip& strip, const OneStrip& before, const Way& way);
  template <class Wait>
  void work_on(const Pass& pass, Index member, Index members, const Wait& wait_for_others);
  void add(const Products& products, double* lanes);
  void put_sums(const Strip& strip, Index piece, double* lanes);

  const TileAccess& tiles_;
  Index pieces_;
  core::Team team_;
  core::Attendance attendance_;
  CacheLines room_[2];
  Eigen::Map<ColumnMatrix> up_,
      sent_;               ///< columns x stride: received from unknowns after, in other rows of tiles; so far
  bool knows_up_ = false;  ///< of the x that there is
  CacheLines lanes_;       ///< of what a strip receives, by member: columns x tile_size x tile_lanes each
  CacheLines sums_;        ///< of it, by piece, of every other strip: columns x part_rows each
  ColumnMatrix received_;  ///< columns x part_rows
};

}  // namespace interflect::solvers
