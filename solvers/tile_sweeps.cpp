#include "solvers/tile_sweeps.h"

#include <algorithm>
#include <bit>
#include <chrono>

#include "core/seconds_since.h"

namespace interflect::solvers {
namespace {

/// On average, at the last row, at least: to add up the lanes takes half a tile's time.
constexpr Index tiles_a_piece = 12;
constexpr Index most_pieces = 64;
constexpr Index same_pieces = 2;  // rows of tiles: where pieces change, threads take over what others have at hand
/// As many take a thread about as long as the new values of a strip, by columns; more than three take both longer.
constexpr Index tiles_to_renew[] = {0, 2, 4, 6};
constexpr Index strips_a_row = tile_size / part_rows;
static_assert(strips_a_row % 2 == 0);  // so that a strip and the next one have sums of their own

constexpr auto nobody = [] {};  // to wait for

Index padded(Index n, Index to) { return (n + to - 1) / to * to; }

}  // namespace

TileSweeps::TileSweeps(const System& system, const TileAccess& tiles, double relaxation, const ColumnMatrix& start,
                       const Run& run)
    : Sweeps(system, relaxation, start, padded(start.rows(), tile_size), tile_size),
      tiles_(tiles),
      pieces_(static_cast<Index>(
          std::bit_floor(static_cast<std::size_t>(std::clamp(tile_rows() / tiles_a_piece, Index{1}, most_pieces))))),
      team_(std::min(run.threads.count(), static_cast<unsigned>(pieces_))),
      attendance_(team_.size()),
      room_{CacheLines(x_.size()), CacheLines(x_.size())},
      up_(room_[0].data(), x_.rows(), x_.cols()),
      sent_(room_[1].data(), x_.rows(), x_.cols()),
      lanes_(team_.size() * columns() * tile_size * tile_lanes),
      sums_(2 * pieces_ * columns() * part_rows),
      received_(columns(), part_rows) {}

void TileSweeps::forward() {
  if (!knows_up_) send_all();
  missing_.setZero();
  sent_.setZero();
  sweep_all({true, up_});
  missing_ += sent_ - up_;
  up_ = sent_;
  knows_up_ = true;
}

void TileSweeps::back() {
  sent_.setZero();
  sweep_all({false, sent_});
  up_ = sent_;
  knows_up_ = true;
}

/// up_ of the x that there is.
void TileSweeps::send_all() {
  sent_.setZero();
  team_.work([&](unsigned member) {
    for (Index s = 0; s < strips(); ++s)
      work_on(pass_of(strip(s, true), strips(), {true, up_}), member, team_.size(), nobody);
  });
  up_ = sent_;
}

/// The s-th strip of a sweep, if there is one.
TileSweeps::OneStrip TileSweeps::strip(Index s, bool ascending) const {
  if (s < 0 || s >= strips()) return std::nullopt;
  const Index at = ascending ? s : strips() - 1 - s;
  return Strip{at / strips_a_row, at % strips_a_row * part_rows};
}

/// Seconds.
double TileSweeps::Steps::wait_for_all(Index passes) const {
  double waited = 0;
  for (const core::StepCount& of_member : passed) waited += of_member.wait_for(passes);
  return waited;
}

/// By all, or by one alone where they would wait for each other: with the same bits.
void TileSweeps::sweep_all(const Way& way) {
  const auto start = std::chrono::steady_clock::now();
  Steps steps{{}, std::vector<core::StepCount>(attendance_.members())};
  std::vector<double> waited(steps.passed.size());
  const auto sweep_by_one = [&](unsigned member) { waited[member] = sweep_by(member, way, steps); };
  if (waited.size() == 1)
    sweep_by_one(0);
  else
    team_.work(sweep_by_one);
  attendance_.add(core::seconds_since(start), *std::ranges::max_element(waited));
}

/// New values of strip s, by member 0, and beside it or after it, by all, a pass: what strip s - ahead sends, and strip
/// s + 1 receives.  The seconds that it waited for others.
double TileSweeps::sweep_by(unsigned member, const Way& way, Steps& steps) {
  const Index members = std::ssize(steps.passed), all = strips(), ahead = members > 1 ? 1 : 0;
  double waited = 0;
  work_on(pass_of({}, 0, way), member, members, nobody);
  steps.passed[member].raise_to(1);
  for (Index s = 0; s < all + ahead; ++s) {
    if (member == 0 && s < all) {
      waited += steps.wait_for_all(s + 1);
      renew(*strip(s, way.ascending), strip(s - 1, way.ascending), way);
      steps.renewed.raise_to(s + 1);
    }
    waited += steps.renewed.wait_for(std::min(all, s + 1 - ahead));
    work_on(pass_of(strip(s - ahead, way.ascending), s + 1, way), member, members,
            [&] { waited += steps.wait_for_all(s + 1); });
    steps.passed[member].raise_to(s + 2);
  }
  return waited;
}

/// How sums over a strip's columns are cut; where nothing is received, how what is sent is.  As if there were more of
/// them, so that the last pieces, member 0's, leave it the time for new values.
TileSweeps::Pieces TileSweeps::pieces(const OneStrip& receiver) const {
  const Index tiles = receiver ? receiver->I : tile_rows();
  return {padded(tiles + tiles_to_renew[std::min<Index>(columns(), 3)], same_pieces), pieces_};
}

/// One pass over what the next strip receives and another sends.
TileSweeps::Pass TileSweeps::pass_of(const OneStrip& sender, Index s, const Way& way) const {
  const OneStrip receiver = strip(s, way.ascending);
  return {.sender = sender,
          .receiver = receiver,
          .next = strip(s + 1, way.ascending),
          .sends = sender ? sender->I - (!way.ascending && has_near(*sender) ? 1 : 0) : 0,
          .receives = receiver ? receiver->I - (way.ascending && has_near(*receiver) ? 1 : 0) : 0,
          .cut = pieces(receiver),
          .cut_before = pieces(s > 0 ? strip(s - 1, way.ascending) : receiver)};
}

/// A member's columns of a pass.  The last ones are member 0's, as behind them lies the tile on the diagonal, which it
/// needs; where pieces cannot be shared out evenly it has fewer, as it makes new values too.  Before it takes over
/// columns that were another's in the pass before, it waits for the end of that.
template <class Wait>
void TileSweeps::work_on(const Pass& pass, Index member, Index members, const Wait& wait_for_others) {
  const Index place = members - 1 - member;
  const auto begin_of = [&](Index p) { return (pieces_ * p + members - 1) / members; };
  const Index first = begin_of(place), end = begin_of(place + 1);
  const Index had_from = pass.cut_before.begin(first), had_to = member == 0 ? tile_rows() : pass.cut_before.begin(end);
  double* lanes = lanes_.data() + member * columns() * tile_size * tile_lanes;
  for (Index piece = first; piece < end; ++piece) {
    const Index from = pass.cut.begin(piece);
    const Index to = piece + 1 < pieces_ ? pass.cut.begin(piece + 1) : std::max(pass.receives, pass.sends);
    if (from < had_from || to > had_to) wait_for_others();
    const Index received = std::clamp(pass.receives, from, std::max(from, to));
    const Index sent = std::clamp(pass.sends, from, std::max(from, to)), both = std::min(received, sent);
    const double* after = nullptr;
    if (piece + 1 == end && member != 0 && pass.next)
      after = tiles_.part(pass.next->I, pass.next->row, std::min(pass.next->I, pieces(pass.next).begin(first)));
    add({from, both, pass.receiver, pass.sender, after}, lanes);
    add({both, received, pass.receiver, {}, after}, lanes);
    add({both, sent, {}, pass.sender, nullptr}, lanes);
    if (pass.receiver) put_sums(*pass.receiver, piece, lanes);
  }
}

/// The products of a pass over some tiles.
void TileSweeps::add(const Products& products, double* lanes) {
  const auto [begin, end, receiver, sender, after] = products;
  if (begin >= end) return;
  TileRows of{.rows = part_rows, .tiles = end - begin, .columns = columns(), .stride = x_.cols(), .step = tile_size};
  if (receiver) {
    of.receiving = tiles_.part(receiver->I, receiver->row, begin);
    of.x = x_.data() + begin * tile_size;
    of.lanes = lanes;
    of.after = after;
  }
  if (sender) {
    of.sending = tiles_.part(sender->I, sender->row, begin);
    of.z = x_.data() + sender->I * tile_size + sender->row;
    of.y = sent_.data() + begin * tile_size;
  }
  add_products(of);
}

/// By piece of a strip and of the one after it: what that receives is summed while this one has its new values made.
double* TileSweeps::sums(const Strip& strip, Index piece) {
  return sums_.data() + (strip.row / part_rows % 2 * pieces_ + piece) * columns() * part_rows;
}

void TileSweeps::put_sums(const Strip& strip, Index piece, double* lanes) {
  double* sum = sums(strip, piece);
  std::fill_n(sum, columns() * part_rows, 0.0);
  add_lanes(part_rows, columns(), lanes, sum, part_rows);
}

/// New values of a strip, for which all but what is near has been received, and sent.
void TileSweeps::renew(const Strip& strip, const OneStrip& before, const Way& way) {
  received_.setZero();
  for (Index piece = 0; piece < pieces_; ++piece)
    received_ += Eigen::Map<const ColumnMatrix>(sums(strip, piece), columns(), part_rows);
  if (way.ascending && has_near(strip)) {
    add({strip.I - 1, strip.I, strip, {}, nullptr}, lanes_.data());
    add_lanes(part_rows, columns(), lanes_.data(), received_.data(), part_rows);
  }
  if (!way.ascending && before && has_near(*before)) add({strip.I, strip.I + 1, {}, before, nullptr}, lanes_.data());

  const Index first = strip.I * tile_size, count = std::min(tile_size, n() - first);
  const Index end = std::min(strip.row + part_rows, count);
  for (Index c = 0; c < columns(); ++c)
    for (Index i = strip.row; i < end; ++i) received_(c, i - strip.row) += way.from_after(c, first + i);
  sweep({first,
         strip.row,
         end,
         {tiles_.part(strip.I, strip.row, strip.I), part_rows, count, tile_size},
         {received_.data(), columns(), part_rows}},
        way.ascending);
}

}  // namespace interflect::solvers
