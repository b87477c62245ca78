#pragma once

#include <array>
#include <functional>

namespace interflect::montecarlo {

/// A function of a direction's cosine in a table that is closer where the direction grazes, by cubics between.
class CosineTable {
 public:
  explicit CosineTable(const std::function<double(double cosine)>& function);
  double operator()(double cosine) const;
  /// Over all directions that arrive alike: int f(c) 2 c dc, of the very table.
  double mean() const { return mean_; }

 private:
  static constexpr int intervals = 64;  ///< equal ones of sqrt(cosine)
  std::array<double, intervals + 1> at_;
  double mean_;
};

}  // namespace interflect::montecarlo
