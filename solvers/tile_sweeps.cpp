#include "solvers/tile_sweeps.h"

#include <algorithm>
#include <bit>

#include "solvers/tile_product.h"

namespace interflect::solvers {
namespace {

constexpr Index tiles_a_task = 16;
constexpr Index rows_a_thread = part_rows;  // 10 000 unknowns: .6 MB on average

Index padded(Index n) { return (n + tile_size - 1) / tile_size * tile_size; }

Index height_for(unsigned threads) { return std::min(rows_a_thread * Index{std::bit_ceil(threads)}, tile_size); }

}  // namespace

TileSweeps::TileSweeps(const System& system, const TileAccess& tiles, double relaxation, const ColumnMatrix& start,
                       const Run& run)
    : Sweeps(system, relaxation, start, padded(start.rows()), tile_size),
      tiles_(tiles),
      run_(run),
      room_{CacheLines(x_.size()), CacheLines(x_.size())},
      up_(room_[0].data(), x_.rows(), x_.cols()),
      sent_(room_[1].data(), x_.rows(), x_.cols()),
      diagonal_(tile_entries),
      lanes_((tile_rows() + tiles_a_task - 1) / tiles_a_task * columns() * tile_size * tile_lanes),
      received_(columns(), tile_size) {}

void TileSweeps::forward() {
  height_ = height_for(run_.threads.count());
  if (!knows_up_) send_all();
  missing_.setZero();
  sent_.setZero();
  std::optional<Strip> before;
  for (Index s = 0; s < strips(); ++s) {
    const Strip now = strip(s);
    send_and_receive(before, now);
    sweep_strip(now, true, up_);
    before = now;
  }
  send_and_receive(before, std::nullopt);
  missing_ += sent_ - up_;
  up_ = sent_;
  knows_up_ = true;
}

void TileSweeps::back() {
  height_ = tile_size;  // sums over the rows of a tile have one order, whatever the strips
  sent_.setZero();
  std::optional<Strip> after;
  for (Index s = strips() - 1; s >= 0; --s) {
    const Strip now = strip(s);
    send_and_receive(after, now);
    sweep_strip(now, false, sent_);
    after = now;
  }
  up_ = sent_;
  knows_up_ = true;
}

/// up_ of the x that there is.
void TileSweeps::send_all() {
  sent_.setZero();
  for (Index s = 0; s < strips(); ++s) send_and_receive(strip(s), std::nullopt);
  up_ = sent_;
}

/// What a strip sends to all tiles before it, and another receives from all before it, into received_: one pass over
/// both, shared by the threads.
void TileSweeps::send_and_receive(const std::optional<Strip>& sender, const std::optional<Strip>& receiver) {
  const Index tiles = std::max(sender ? sender->I : 0, receiver ? receiver->I : 0);
  const Index part = columns() * tile_size * tile_lanes;
  run_.threads.for_blocks(tiles, tiles_a_task, [&](Index begin, Index end) {
    pass_tiles(sender, receiver, begin, end, lanes_.data() + begin / tiles_a_task * part);
  });
  if (!receiver) return;
  received_.setZero();
  for (Index task = 0; task * tiles_a_task < receiver->I; ++task)
    add_lanes(height_, columns(), lanes_.data() + task * part, received_.data() + receiver->row, tile_size);
}

void TileSweeps::pass_tiles(const std::optional<Strip>& sender, const std::optional<Strip>& receiver, Index begin,
                            Index end, double* lanes) {
  const Index sent = sender ? std::clamp(sender->I, begin, end) : begin;
  const Index received = receiver ? std::clamp(receiver->I, begin, end) : begin;
  for (Index row = 0; row < height_; row += part_rows) {
    const auto pass = [&](Index first, Index last, bool sends, bool receives) {
      if (first >= last) return;
      TileRows of{
          .rows = part_rows, .tiles = last - first, .columns = columns(), .stride = x_.cols(), .step = tile_size};
      if (receives) {
        of.receiving = tiles_.part(receiver->I, receiver->row + row, first);
        of.x = x_.data() + first * tile_size;
        of.lanes = lanes + row * tile_lanes;
      }
      if (sends) {
        of.sending = tiles_.part(sender->I, sender->row + row, first);
        of.z = x_.data() + sender->I * tile_size + sender->row + row;
        of.y = sent_.data() + first * tile_size;
      }
      add_products(of);
    };
    const Index both = std::min(sent, received);
    pass(begin, both, true, true);
    pass(both, sent, true, false);
    pass(both, received, false, true);
  }
}

void TileSweeps::fetch_diagonal(Index I) {
  if (diagonal_of_ == I) return;
  for (Index row = 0; row < tile_size; row += part_rows)
    std::copy_n(tiles_.part(I, row, I), part_entries, diagonal_.data() + row * tile_size);
  diagonal_of_ = I;
}

/// New values of a strip, which has received what comes from the tiles before it.
void TileSweeps::sweep_strip(const Strip& strip, bool ascending, ConstColumns from_after) {
  const Index first = strip.I * tile_size, count = std::min(tile_size, n() - first);
  const Index end = std::min(strip.row + height_, count);
  fetch_diagonal(strip.I);
  for (Index c = 0; c < columns(); ++c)
    for (Index i = strip.row; i < end; ++i) received_(c, i) += from_after(c, first + i);
  sweep({first, strip.row, end, {diagonal_.data(), count, count, tile_size}, {received_.data(), columns(), tile_size}},
        ascending);
}

}  // namespace interflect::solvers
