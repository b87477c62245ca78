#pragma once

#include <string>
#include <vector>

namespace interflect::apps {

/// Rows of cells in aligned columns for a terminal: the first column to the left, the rest to the right.
class Table {
 public:
  explicit Table(std::vector<std::string> header) : rows_{std::move(header)} {}
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace interflect::apps
