#pragma once

#include <vector>

#include "core/vec.h"

namespace interflect::solvers {

/// Numbers, 0 at first, that begin where a line of the cache does: what vectors of 64 bytes load and store at once.
class CacheLines {
 public:
  CacheLines() = default;
  explicit CacheLines(Index count) : lines_(static_cast<std::size_t>((count + a_line - 1) / a_line)) {}
  double* data() { return lines_.empty() ? nullptr : lines_.front().values; }
  void set_zero() { lines_.assign(lines_.size(), Line{}); }
  const double* data() const { return lines_.empty() ? nullptr : lines_.front().values; }

 private:
  static constexpr Index a_line = 8;
  struct alignas(64) Line {
    double values[a_line] = {};
  };
  std::vector<Line> lines_;
};

}  // namespace interflect::solvers
