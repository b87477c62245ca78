#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace interflect::montecarlo {

/// Picks i with probability weight[i] / sum of weights, in constant time.
/// Source: [Walker 1977], built as in [Vose 1991].
class AliasTable {
 public:
  AliasTable() = default;
  explicit AliasTable(std::span<const double> weights);  ///< >= 0 and not all 0, or empty

  std::size_t size() const { return cells_.size(); }
  double total() const { return total_; }  ///< of the weights

  /// @param u  uniform in [0, 1); its high part chooses the cell, the rest decides within it
  std::uint32_t pick(double u) const {
    const double scaled = u * static_cast<double>(cells_.size());
    const auto cell = static_cast<std::uint32_t>(scaled);
    return scaled - cell < cells_[cell].keep ? cell : cells_[cell].alias;
  }

 private:
  struct Cell {
    double keep = 1;  ///< probability of the cell's own item; else its alias
    std::uint32_t alias = 0;
  };
  std::vector<Cell> cells_;
  double total_ = 0;
};

}  // namespace interflect::montecarlo
