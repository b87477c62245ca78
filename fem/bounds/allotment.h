#pragma once

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace interflect::fem {

/// max sum_k value_k x_k  with  0 <= x_k <= most_k  and  sum x_k <= left: the dearest first.
class Allotment {
 public:
  void clear() { entries_.clear(); }
  void add(double value, double most) {
    if (value > 0 && most > 0) entries_.emplace_back(value, most);
  }
  double largest_sum(double left) {
    std::sort(entries_.begin(), entries_.end(), std::greater<>());
    double sum = 0;
    for (const auto& [value, most] : entries_) {
      if (!(left > 0)) break;
      const double x = std::min(left, most);
      sum += x * value;
      left -= x;
    }
    return sum;
  }

 private:
  std::vector<std::pair<double, double>> entries_;
};

}  // namespace interflect::fem
