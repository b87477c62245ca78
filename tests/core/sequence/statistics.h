#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

/// Counts of cells against chi-squared, and rates of convergence.
namespace interflect::core::test {

/// z that a normal number is above with probability alpha.
inline double upper_z(double alpha) {
  double low = -40, high = 40;
  for (int i = 0; i < 100; ++i)
    (.5 * std::erfc((low + high) / 2 / std::sqrt(2.)) > alpha ? low : high) = (low + high) / 2;
  return low;
}

/// What chi-squared with so many degrees of freedom is above with probability alpha [Wilson, Hilferty 1931].
inline double chi_squared_limit(double dof, double alpha) {
  return dof * std::pow(1 - 2 / (9 * dof) + upper_z(alpha) * std::sqrt(2 / (9 * dof)), 3);
}

/// How often each of some cells was met, which are equally likely.
class Cells {
 public:
  explicit Cells(std::size_t cells) : counts_(cells) {}
  void add(std::size_t cell) { ++counts_.at(cell), ++n_; }
  const std::vector<int>& counts() const { return counts_; }
  double chi_squared() const {
    const double expected = double(n_) / double(counts_.size());
    double sum = 0;
    for (const int count : counts_) sum += (count - expected) * (count - expected) / expected;
    return sum;
  }
  /// Alpha is of a test of this one.
  bool uniform(double alpha) const { return chi_squared() < chi_squared_limit(double(counts_.size()) - 1, alpha); }

 private:
  std::vector<int> counts_;
  int n_ = 0;
};

/// That a number in [0, 1) is in, of so many equal ones.
inline std::size_t interval_of(double u, std::size_t intervals) {
  return static_cast<std::size_t>(u * double(intervals));
}

/// The slope of the straight line of least squares.
inline double slope(const std::vector<double>& x, const std::vector<double>& y) {
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) mean_x += x[i] / double(x.size()), mean_y += y[i] / double(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    xx += (x[i] - mean_x) * (x[i] - mean_x), xy += (x[i] - mean_x) * (y[i] - mean_y);
  return xy / xx;
}

/// How many standard deviations r squares of normal numbers, summed and over their variance, are off:
/// (S - r) / sqrt(2 r).
inline double off_by(double sum_over_variance, double r) { return (sum_over_variance - r) / std::sqrt(2 * r); }

}  // namespace interflect::core::test
