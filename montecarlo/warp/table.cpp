#include "montecarlo/warp/table.h"

#include <algorithm>

namespace interflect::montecarlo {
namespace {

std::vector<CellRow> rows_of(int rows, int columns, std::span<const double> weights) {
  std::vector<CellRow> out;
  for (int r = 0; r < rows; ++r)
    out.emplace_back(weights.subspan(static_cast<std::size_t>(r) * static_cast<std::size_t>(columns),
                                     static_cast<std::size_t>(columns)));
  return out;
}

std::vector<double> totals_of(const std::vector<CellRow>& rows) {
  std::vector<double> totals;
  for (const CellRow& row : rows) totals.push_back(row.total());
  return totals;
}

}  // namespace

CellRow::CellRow(std::span<const double> weights) : before_{0} {
  for (std::size_t i = 0; i < weights.size(); ++i) {
    before_.push_back(before_.back() + weights[i]);
    if (before_[i + 1] > before_[i]) last_ = static_cast<int>(i);
  }
}

CellRow::Picked CellRow::pick(double u) const {
  const double sum = u * total();
  const auto above = std::upper_bound(before_.begin() + 1, before_.end(), sum);
  const int cell = std::min(last_, static_cast<int>(above - before_.begin()) - 1);
  return {cell, std::clamp((sum - before_[at(cell)]) / weight(cell), 0., 1.)};
}

CellTable::CellTable(int rows, int columns, std::span<const double> weights)
    : of_row_(rows_of(rows, columns, weights)), rows_(totals_of(of_row_)) {}

CellTable::Picked CellTable::pick(double u, double v) const {
  const CellRow::Picked row = rows_.pick(u);
  return {row, of_row_[static_cast<std::size_t>(row.cell)].pick(v)};
}

Vec2 CellTable::inverse(const Picked& picked) const {
  return {rows_.inverse(picked.row), of_row_[static_cast<std::size_t>(picked.row.cell)].inverse(picked.column)};
}

}  // namespace interflect::montecarlo
