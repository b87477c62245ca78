#include "fem/space/polynomials.h"

#include <array>
#include <cassert>
#include <cmath>

namespace interflect::fem {

namespace {

constexpr int highest_order = 8;
using Values = std::array<double, highest_order + 1>;

/// Position of (i, j) among all, by i + j and then by j.
constexpr std::size_t position(int i, int j) { return static_cast<std::size_t>((i + j) * (i + j + 1) / 2 + j); }

/// P_n^(alpha,0)(x), n <= order.  Source: [Abramowitz, Stegun 1964] 22.7.1 with beta = 0.
Values jacobi(int order, double alpha, double x) {
  Values P{};
  P[0] = 1;
  if (order >= 1) P[1] = 0.5 * (alpha + (alpha + 2) * x);
  for (int n = 1; n < order; ++n) {
    const double m = 2 * n + alpha, scale = 2 * (n + 1) * (n + alpha + 1) * m;
    const auto k = static_cast<std::size_t>(n);
    P[k + 1] = ((m + 1) * (m * (m + 2) * x + alpha * alpha) * P[k] - 2 * (n + alpha) * n * (m + 2) * P[k - 1]) / scale;
  }
  return P;
}

}  // namespace

void legendre(double x, std::span<double> out) {
  double before = 0, value = 1;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto n = static_cast<double>(i);
    out[i] = std::sqrt(2 * n + 1) * value;
    const double next = ((2 * n + 1) * x * value - n * before) / (n + 1);
    before = value;
    value = next;
  }
}

void legendre_products(int order, double x, double y, std::span<double> out) {
  assert(order <= highest_order && out.size() == static_cast<std::size_t>(plane_functions(order)));
  Values of_x{}, of_y{};
  const auto count = static_cast<std::size_t>(order) + 1;
  legendre(x, std::span(of_x).first(count));
  legendre(y, std::span(of_y).first(count));
  for (int i = 0; i <= order; ++i)
    for (int j = 0; i + j <= order; ++j)
      out[position(i, j)] = of_x[static_cast<std::size_t>(i)] * of_y[static_cast<std::size_t>(j)];
}

void dubiner(int order, double u, double v, std::span<double> out) {
  assert(order <= highest_order && out.size() == static_cast<std::size_t>(plane_functions(order)));
  const double w = 1 - v, s = 2 * u - w;  // P_i(s / w) w^i
  double before = 0, value = 1;
  for (int i = 0; i <= order; ++i) {
    const Values P = jacobi(order - i, 2 * i + 1, 2 * v - 1);
    for (int j = 0; i + j <= order; ++j)
      out[position(i, j)] = std::sqrt((2.0 * i + 1) * (i + j + 1)) * value * P[static_cast<std::size_t>(j)];
    const double next = ((2 * i + 1) * s * value - i * w * w * before) / (i + 1);
    before = value;
    value = next;
  }
}

}  // namespace interflect::fem
