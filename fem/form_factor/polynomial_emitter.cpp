#include "fem/form_factor/polynomial_emitter.h"

#include <array>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

#include "fem/form_factor/dilogarithm.h"

namespace interflect::fem {

namespace {

constexpr int highest = 4;  ///< degree of the monomials in I_ij: one more than that of radiosity

using Grid = std::array<std::array<double, highest + 1>, highest + 1>;  ///< [i][j]

/// One edge, seen from the foot: points d m + t tau, t_0 <= t <= t_1.
struct Edge {
  Vec2 m, tau;
  double d, t_0, t_1;
};

Edge edge_of(const Vec2& from, const Vec2& to) {
  const Vec2 tau = (to - from).normalized(), m(tau.y(), -tau.x());
  return {m, tau, m.dot(from), tau.dot(from), tau.dot(to)};
}

/// int t^k / (t² + s²) dt, k <= 3, and int t^k ln(t² + s²) dt, k <= 1, along an edge; s² = d² + h².
struct LineIntegrals {
  std::array<double, 4> over_square;
  std::array<double, 2> logarithm;
};

LineIntegrals line_integrals(const Edge& edge, double h) {
  const double a = edge.t_0, b = edge.t_1, s2 = edge.d * edge.d + h * h, s = std::sqrt(s2), u_a = a * a + s2,
               u_b = b * b + s2;
  LineIntegrals line{};
  line.over_square[0] = std::atan2(s * (b - a), s2 + a * b) / s;
  line.over_square[1] = 0.5 * std::log(u_b / u_a);
  line.over_square[2] = b - a - s2 * line.over_square[0];
  line.over_square[3] = 0.5 * (b * b - a * a) - s2 * line.over_square[1];
  line.logarithm[0] = b * std::log(u_b) - a * std::log(u_a) - 2 * line.over_square[2];
  line.logarithm[1] = 0.5 * (u_b * std::log(u_b) - u_a * std::log(u_a) - (u_b - u_a));
  return line;
}

/// Im Li2(-q e^{2 i phi}), tan phi = t / d, for 0 < q <= 1: no logarithm of what cancels.
double dilogarithm_at(double q, double log_q, double phi, double t, double d) {
  const double square = d * d + t * t, cosine = (d * d - t * t) / square, sine = 2 * t * d / square,
               from_1 = (1 - q) * (1 - q) + 4 * q * d * d / square;  // |1 + q e^{2 i phi}|²
  const std::complex<double> log_z(log_q, phi > 0 ? 2 * phi - std::numbers::pi : 2 * phi + std::numbers::pi),
      log_1_minus_z(0.5 * std::log(from_1), q == 1 ? phi : std::atan2(q * sine, 1 + q * cosine));
  return dilogarithm_imaginary({-q * cosine, -q * sine}, log_z, log_1_minus_z);
}

/// Its part of J_00.
double dilogarithms(const Edge& edge, double h) {
  if (edge.d == 0) return 0;
  const double d = std::abs(edge.d), k = d / h, root = std::sqrt(1 + k * k), log_q = -2 * std::asinh(k),
               q = 1 / ((root + k) * (root + k));
  const auto at = [&](double t) {
    const double phi = std::atan(t / d);
    return -phi * log_q - dilogarithm_at(q, log_q, phi, t, d) + dilogarithm_at(1, 0, phi, t, d);
  };
  return std::copysign(0.5, edge.d) * (at(edge.t_1) - at(edge.t_0));
}

/// Coefficients of (d m_1 + t tau_1)^i (d m_2 + t tau_2)^j in powers of t.
std::array<double, 4> along(const Edge& edge, int i, int j) {
  std::array<double, 4> powers{1, 0, 0, 0};
  const auto multiply = [&](double constant, double slope) {
    for (std::size_t k = powers.size(); k-- > 0;)
      powers[k] = constant * powers[k] + (k > 0 ? slope * powers[k - 1] : 0);
  };
  for (int k = 0; k < i; ++k) multiply(edge.d * edge.m.x(), edge.tau.x());
  for (int k = 0; k < j; ++k) multiply(edge.d * edge.m.y(), edge.tau.y());
  return powers;
}

/// A polygon about the foot, as edges with their integrals.
class Outline {
 public:
  Outline(std::span<const Vec2> corners, double h) : h_(h) {
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec2 &from = corners[k], &to = corners[k + 1 < corners.size() ? k + 1 : 0];
      if (from == to) continue;
      edge_[count_] = edge_of(from, to);
      line_[count_] = line_integrals(edge_[count_], h);
      area_ += 0.5 * (from.x() * to.y() - from.y() * to.x());
      ++count_;
    }
  }

  /// line(xi^i eta^j weight / r²)
  template <class Weight>
  double over_square(int i, int j, const Weight& weight) const {
    double sum = 0;
    for (std::size_t e = 0; e < count_; ++e) {
      const auto powers = along(edge_[e], i, j);
      double of_edge = 0;
      for (std::size_t k = 0; k < powers.size(); ++k) of_edge += powers[k] * line_[e].over_square[k];
      sum += weight(edge_[e]) * of_edge;
    }
    return sum;
  }
  /// line(xi^i eta^j weight ln r²), i + j <= 1
  template <class Weight>
  double logarithm(int i, int j, const Weight& weight) const {
    double sum = 0;
    for (std::size_t e = 0; e < count_; ++e) {
      const auto powers = along(edge_[e], i, j);
      sum += weight(edge_[e]) * (powers[0] * line_[e].logarithm[0] + powers[1] * line_[e].logarithm[1]);
    }
    return sum;
  }
  double dilogarithms() const {
    double sum = 0;
    for (std::size_t e = 0; e < count_; ++e) sum += fem::dilogarithms(edge_[e], h_);
    return sum;
  }
  double area() const { return area_; }

 private:
  static constexpr std::size_t most_edges = 16;
  std::array<Edge, most_edges> edge_;
  std::array<LineIntegrals, most_edges> line_;
  std::size_t count_ = 0;
  double h_, area_ = 0;
};

double m_1(const Edge& edge) { return edge.m.x(); }
double m_2(const Edge& edge) { return edge.m.y(); }
double distance(const Edge& edge) { return edge.d; }

/// J_ij, i + j <= degree <= 2.
Grid over_square_integrals(const Outline& outline, double h, int degree) {
  Grid J{};
  J[0][0] = outline.dilogarithms();
  if (degree < 1) return J;
  J[1][0] = 0.5 * outline.logarithm(0, 0, m_1);
  J[0][1] = 0.5 * outline.logarithm(0, 0, m_2);
  if (degree < 2) return J;
  const double L = 0.5 * outline.logarithm(0, 0, distance) - outline.area() + h * h * J[0][0];
  J[2][0] = 0.5 * (outline.logarithm(1, 0, m_1) - L);
  J[0][2] = 0.5 * (outline.logarithm(0, 1, m_2) - L);
  J[1][1] = 0.5 * outline.logarithm(0, 1, m_1);
  return J;
}

/// h I_ij, i + j <= degree <= 4; of I_00 h² I_00, which stays finite where h does not.
Grid over_fourth_power(const Outline& outline, double h, int degree) {
  const Grid J = degree >= 2 ? over_square_integrals(outline, h, degree - 2) : Grid{};
  Grid I{};
  I[0][0] = 0.5 * outline.over_square(0, 0, distance);
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j) {
      if (i + j == 0) continue;
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      const double area = i > 1             ? (i - 1) * J[a - 2][b]
                          : i == 0 && j > 1 ? (j - 1) * J[0][b - 2]
                                            : 0,
                   line = i > 0 ? outline.over_square(i - 1, j, m_1) : outline.over_square(0, j - 1, m_2);
      I[a][b] = 0.5 * h * (area - line);
    }
  return I;
}

constexpr double binomial[highest][highest] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}};

/// 1, x, x², x³
std::array<double, highest> powers_of(double x) { return {1, x, x * x, x * x * x}; }

}  // namespace

void point_to_monomials(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon, const PlaneFrame& frame, int order,
                        std::span<double> out) {
  assert(order >= 0 && order < highest && polygon.size() >= 3 && polygon.size() <= 16);
  std::fill(out.begin(), out.end(), 0.0);
  const Vec3 e_3 = frame.e_1.cross(frame.e_2), to_x = x - frame.origin;
  const double h = e_3.dot(to_x);
  if (!(h > 0)) return;
  const Vec2 foot(frame.e_1.dot(to_x), frame.e_2.dot(to_x));
  std::array<Vec2, 16> corner;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 p = polygon[k] - x;
    corner[k] = {frame.e_1.dot(p), frame.e_2.dot(p)};
  }
  const Outline outline({corner.data(), polygon.size()}, h);
  const Grid I = over_fourth_power(outline, h, order + 1);
  const double n_1 = n.dot(frame.e_1), n_2 = n.dot(frame.e_2), n_3 = n.dot(e_3);
  Grid about_foot{};
  for (std::size_t i = 0; static_cast<int>(i) <= order; ++i)
    for (std::size_t j = 0; static_cast<int>(i + j) <= order; ++j)
      about_foot[i][j] = inv_pi * (n_1 * I[i + 1][j] + n_2 * I[i][j + 1] - (i + j == 0 ? 1 : h) * n_3 * I[i][j]);
  const auto foot_1 = powers_of(foot.x()), foot_2 = powers_of(foot.y());
  const auto degree = static_cast<std::size_t>(order);
  for (std::size_t total = 0, to = 0; total <= degree; ++total)
    for (std::size_t j = 0; j <= total; ++j, ++to) {  // xi^i eta^j, from powers of (xi - foot) and (eta - foot)
      const std::size_t i = total - j;
      double sum = 0;
      for (std::size_t k = 0; k <= i; ++k)
        for (std::size_t l = 0; l <= j; ++l)
          sum += binomial[i][k] * binomial[j][l] * foot_1[i - k] * foot_2[j - l] * about_foot[k][l];
      out[to] = sum;
    }
}

}  // namespace interflect::fem
