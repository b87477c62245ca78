#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/apps/csv_rows.h"

namespace interflect::test {

/// A CSV file whose numbers are found by the names in its first column and by its headings.
class CsvTable {
 public:
  explicit CsvTable(const std::string& path) : rows_(read_csv(path)) {}

  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (std::size_t k = 1; k < rows_.size(); ++k) names.push_back(rows_[k].front());
    return names;
  }
  bool has(const std::string& name) const {
    const auto all = names();
    return std::find(all.begin(), all.end(), name) != all.end();
  }
  /// NaN, and a failed test, where there is no such row or column.
  double at(const std::string& name, const std::string& column) const {
    for (std::size_t k = 1; k < rows_.size(); ++k)
      for (std::size_t c = 0; c < rows_.front().size() && c < rows_[k].size(); ++c)
        if (rows_[k].front() == name && rows_.front()[c] == column) return std::stod(rows_[k][c]);
    ADD_FAILURE() << "no " << column << " of " << name;
    return std::nan("");
  }

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace interflect::test
