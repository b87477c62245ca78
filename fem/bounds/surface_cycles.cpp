#include "fem/bounds/surface_cycles.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "core/disjoint_sets.h"

namespace interflect::fem {
namespace {

using Numbers = std::vector<std::uint32_t>;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// The cells at each piece, of those that may be in a cycle.
std::vector<Numbers> cells_at(const EdgePieces& pieces) {
  std::vector<Numbers> at(pieces.count);
  for (std::uint32_t cell = 0; cell < pieces.of.size(); ++cell)
    for (const std::uint32_t piece : pieces.of[cell]) at[piece].push_back(cell);
  Numbers lonely;
  for (std::uint32_t piece = 0; piece < pieces.count; ++piece)
    if (at[piece].size() == 1) lonely.push_back(piece);
  while (!lonely.empty()) {
    const std::uint32_t piece = lonely.back();
    lonely.pop_back();
    if (at[piece].empty()) continue;
    const std::uint32_t cell = at[piece].front();
    for (const std::uint32_t other : pieces.of[cell]) {
      std::erase(at[other], cell);
      if (at[other].size() == 1) lonely.push_back(other);
    }
  }
  return at;
}

/// Equations sum x = 0 mod 2 in few unknowns.
class Elimination {
 public:
  explicit Elimination(std::size_t unknowns) : row_of_(unknowns), words_((unknowns + 63) / 64) {}

  void add(std::span<const std::uint32_t> unknowns) {
    Row row(words_, 0);
    for (const std::uint32_t k : unknowns) row[k / 64] ^= bit(k);
    for (std::uint32_t k = 0; k < row_of_.size(); ++k)
      if (has(row, k) && !row_of_[k].empty()) add_to(row, row_of_[k]);
    for (std::uint32_t pivot = 0; pivot < row_of_.size(); ++pivot) {
      if (!has(row, pivot)) continue;
      for (Row& other : row_of_)
        if (!other.empty() && has(other, pivot)) add_to(other, row);
      row_of_[pivot] = std::move(row);
      return;
    }
  }
  /// A basis of the solutions, each as the unknowns that are 1.
  std::vector<Numbers> solutions() const {
    std::vector<Numbers> all;
    for (std::uint32_t free = 0; free < row_of_.size(); ++free) {
      if (!row_of_[free].empty()) continue;
      Numbers ones{free};
      for (std::uint32_t pivot = 0; pivot < row_of_.size(); ++pivot)
        if (!row_of_[pivot].empty() && has(row_of_[pivot], free)) ones.push_back(pivot);
      all.push_back(std::move(ones));
    }
    return all;
  }

 private:
  using Row = std::vector<std::uint64_t>;
  static std::uint64_t bit(std::uint32_t k) { return std::uint64_t{1} << (k % 64); }
  static bool has(const Row& row, std::uint32_t k) { return (row[k / 64] & bit(k)) != 0; }
  static void add_to(Row& row, const Row& other) {
    for (std::size_t w = 0; w < row.size(); ++w) row[w] ^= other[w];
  }

  std::vector<Row> row_of_;  ///< by pivot, which is in no other row; empty where an unknown is none
  std::size_t words_;
};

/// Sheets and what holds between them.
class Sheets {
 public:
  Sheets(const EdgePieces& pieces, std::span<const Numbers> cells_at_piece)
      : sheet_of_(pieces.of.size(), none), cells_(pieces.of.size()) {
    for (const Numbers& cells : cells_at_piece)
      if (cells.size() == 2) cells_.join(cells[0], cells[1]);
    for (const Numbers& cells : cells_at_piece)
      for (const std::uint32_t cell : cells) sheet_of_[cell] = cells_.of(cell);
    for (const Numbers& cells : cells_at_piece)
      if (cells.size() > 2) add_equation(cells);
  }

  /// The cycles of each sheet, by its first cell.
  std::map<std::uint32_t, Numbers> cycles() {
    core::DisjointSets joined(sheet_of_.size());
    for (const Numbers& equation : equations_)
      for (const std::uint32_t sheet : equation) joined.join(equation.front(), sheet);
    std::map<std::uint32_t, Numbers> sheets_of;  // by the first that they are joined with
    for (std::uint32_t cell = 0; cell < sheet_of_.size(); ++cell)
      if (sheet_of_[cell] == cell) sheets_of[joined.of(cell)].push_back(cell);
    std::map<std::uint32_t, std::vector<const Numbers*>> equations_of;
    for (const Numbers& equation : equations_) equations_of[joined.of(equation.front())].push_back(&equation);
    std::map<std::uint32_t, Numbers> out;
    std::uint32_t cycles = 0;
    for (const auto& [first, sheets] : sheets_of) add_cycles(sheets, equations_of[first], cycles, out);
    return out;
  }
  std::uint32_t sheet_of(std::uint32_t cell) const { return sheet_of_[cell]; }

 private:
  void add_equation(const Numbers& cells) {
    std::map<std::uint32_t, int> times;
    for (const std::uint32_t cell : cells) ++times[sheet_of_[cell]];
    Numbers odd;
    for (const auto& [sheet, n] : times)
      if (n % 2 == 1) odd.push_back(sheet);
    if (!odd.empty()) equations_.insert(std::move(odd));
  }
  static void add_cycles(const Numbers& sheets, std::span<const Numbers* const> equations, std::uint32_t& cycles,
                         std::map<std::uint32_t, Numbers>& out) {
    constexpr std::size_t most = 4096;
    if (sheets.size() > most) return;
    Elimination elimination(sheets.size());
    for (const Numbers* equation : equations) {
      Numbers unknowns;
      for (const std::uint32_t sheet : *equation)
        unknowns.push_back(
            static_cast<std::uint32_t>(std::lower_bound(sheets.begin(), sheets.end(), sheet) - sheets.begin()));
      elimination.add(unknowns);
    }
    for (const Numbers& ones : elimination.solutions()) {
      for (const std::uint32_t k : ones) out[sheets[k]].push_back(cycles);
      ++cycles;
    }
  }

  Numbers sheet_of_;  ///< by cell, the first cell of its sheet; `none` where it is in no cycle
  core::DisjointSets cells_;
  std::set<Numbers> equations_;
};

}  // namespace

std::vector<Numbers> surface_cycles(const EdgePieces& pieces) {
  Sheets sheets(pieces, cells_at(pieces));
  const std::map<std::uint32_t, Numbers> cycles = sheets.cycles();
  std::vector<Numbers> of(pieces.of.size());
  for (std::uint32_t cell = 0; cell < of.size(); ++cell)
    if (const auto found = cycles.find(sheets.sheet_of(cell)); found != cycles.end()) of[cell] = found->second;
  return of;
}

}  // namespace interflect::fem
