#pragma once

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <vector>

#include "fem/space/space.h"

/// Two strips of flatland, of width 1 and 0.5 apart, that face each other; the first one emits 1.
namespace interflect::fem::test {

inline constexpr double strip_gap = .5;

/// Of so many segments a strip.
inline std::vector<Panel> facing_strips(int n) {
  std::vector<Panel> panels;
  for (int k = 0; k < n; ++k) panels.push_back(segment_panel({double(k) / n, 0, 0}, {double(k + 1) / n, 0, 0}));
  for (int k = 0; k < n; ++k)
    panels.push_back(segment_panel({double(k + 1) / n, strip_gap, 0}, {double(k) / n, strip_gap, 0}));
  return panels;
}
inline bool on_first_strip(const Vec3& x) { return x.y() < .5 * strip_gap; }
inline double strip_exitance(const Vec3& x) { return on_first_strip(x) ? 1 : 0; }

/// B by Nystrom's method with Gauss points on either strip, which converges exponentially: to rounding here.
class ExactStrips {
 public:
  using Reflectance = std::function<double(double)>;  ///< along both strips, 0 .. 1

  explicit ExactStrips(Reflectance rho) : rho_(std::move(rho)), rule_(gauss_legendre(points)) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(2 * points, 2 * points);
    Eigen::VectorXd e = Eigen::VectorXd::Zero(2 * points);
    e.head(points).setOnes();
    for (int i = 0; i < points; ++i)
      for (int j = 0; j < points; ++j) {
        const double k = rho_(node(i)) * weight(j) * kernel(node(i) - node(j));
        A(i, points + j) -= k;
        A(points + i, j) -= k;
      }
    B_ = A.partialPivLu().solve(e);
  }
  double operator()(const Vec3& x) const {
    double H = 0;
    const Index other = on_first_strip(x) ? points : 0;
    for (int j = 0; j < points; ++j) H += weight(j) * kernel(x.x() - node(j)) * B_[other + j];
    return strip_exitance(x) + rho_(x.x()) * H;
  }

 private:
  static constexpr int points = 80;
  double node(int j) const { return rule_[std::size_t(j)].u; }
  double weight(int j) const { return rule_[std::size_t(j)].weight; }
  static double kernel(double dx) {
    return .5 * strip_gap * strip_gap / std::pow(strip_gap * strip_gap + dx * dx, 1.5);
  }

  Reflectance rho_;
  Rule rule_;
  Eigen::VectorXd B_;
};

}  // namespace interflect::fem::test
