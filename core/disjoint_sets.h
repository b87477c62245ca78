#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace interflect::core {

/// Of 0 .. n - 1, each by itself at first, sets that may be joined; a set is named by its least member.
/// Source: [Tarjan, van Leeuwen 1984], paths halved on the way.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : above_(n) { std::iota(above_.begin(), above_.end(), 0U); }

  std::uint32_t of(std::uint32_t k) {
    while (above_[k] != k) k = above_[k] = above_[above_[k]];
    return k;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = of(a), b = of(b);
    above_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> above_;
};

}  // namespace interflect::core
