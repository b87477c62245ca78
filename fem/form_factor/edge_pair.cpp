#include "fem/form_factor/edge_pair.h"

#include <array>
#include <cmath>
#include <limits>

#include "fem/form_factor/dilogarithm.h"

namespace interflect::fem {

namespace {

constexpr double rounding = 0.5 * std::numeric_limits<double>::epsilon();
/// Lines whose angle's sine is below this are taken for parallel: there the error of that, sigma, is as large as the
/// other's, rounding / sigma.
constexpr double parallel_sine = 3e-8;
/// Lines this close where they are closest are taken to meet: h² ln h is lost to rounding.
constexpr double meeting_distance = 1e-17;

/// a b - c d to rounding of the result, not of the products (Kahan).
double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d, lost = std::fma(-c, d, cd);
  return std::fma(a, b, -cd) + lost;
}
Vec3 accurate_cross(const Vec3& a, const Vec3& b) {
  return {difference_of_products(a.y(), b.z(), a.z(), b.y()), difference_of_products(a.z(), b.x(), a.x(), b.z()),
          difference_of_products(a.x(), b.y(), a.y(), b.x())};
}

/// G(v) of parallel lines at distance d, v > 0 or not.
void add_parallel_corner(double sign, double v, double d, SizedSum& sum) {
  const double v2 = v * v, d2 = d * d, r2 = v2 + d2;
  if (r2 <= 0.0) return;
  sum.add(sign * (0.25 * (v2 - d2) * std::log(r2) - 0.75 * v2));
  sum.size += 0.5 * r2;  // r² is rounded before its logarithm
  if (d > 0.0) sum.add(sign * d * v * std::atan(v / d));
}

Integral parallel_edges(const Edge& e, const Edge& f, double sine) {
  // About the middles, so that a small angle tilts neither end more than the other.
  const Vec3 w = 0.5 * ((e.from - f.from) + (e.to - f.to));
  const double offset = w.dot(f.direction), d = (w - offset * f.direction).norm(), a = 0.5 * e.length,
               b = 0.5 * f.length;
  SizedSum sum;
  add_parallel_corner(1, offset + a + b, d, sum);
  add_parallel_corner(1, offset - a - b, d, sum);
  add_parallel_corner(-1, offset + a - b, d, sum);
  add_parallel_corner(-1, offset - a + b, d, sum);
  // Turning e about its middle, across f, changes ln r by at most sine |s| d / (d² + v²): in all by sine pi L_e² / 4.
  return {sum.value, rounding * sum.size + sine * e.length * e.length};
}

/// The end of a side of the rectangle: u, and what two sides share.
struct End {
  double u, r, ln_r2;
};

class SkewLines {
 public:
  SkewLines(double sine, double h) : sine_(sine), h_(h > meeting_distance ? h : 0.0), ln_h2_(2 * std::log(h_)) {}

  /// S (int g du) from one end to the other.
  void add_side(double S, const End& from, const End& to, SizedSum& sum) const {
    const double p = sine_ * std::abs(S), m = std::hypot(h_, p);
    if (p == 0.0) return;
    const double angle_from = std::atan(from.u / m), angle_to = std::atan(to.u / m);
    sum.add(0.25 * S * (to.u * (to.ln_r2 - 3)));
    sum.add(-0.25 * S * (from.u * (from.ln_r2 - 3)));
    sum.add(0.5 * S * m * angle_to);
    sum.add(-0.5 * S * m * angle_from);
    sum.size += 0.5 * std::abs(S) * (to.r + from.r);  // u and m are rounded as the r that they are parts of
    if (h_ <= 0.0) return;
    const double root = std::hypot(1.0, p / h_) + p / h_, ln_b = -2 * std::log(root);
    const Dilogarithms of{p, 1 / (root * root), ln_b, ln_b - ln_h2_ + 2 * std::log(p)};
    const double factor = std::copysign(0.25 * h_ * h_ / sine_, S);
    sum.add(factor * of(to, angle_to));
    sum.add(-factor * of(from, angle_from));
  }

 private:
  /// D at one end of a side.
  struct Dilogarithms {
    double p, b, ln_b, ln_b_p2_h2;

    double operator()(const End& end, double angle) const {
      const double u = end.u, R2 = p * p + u * u, ln_R2 = std::log(R2), theta = std::atan2(u, p);
      const double cosine = (p * p - u * u) / R2, sine = 2 * p * u / R2;
      // 1 + b e^{2 i theta} has the modulus² 4 b (p² / h²) r² / R² and, by b's definition, the argument theta -
      // atan(u/m).
      constexpr double ln_4 = 1.3862943611198906;
      const double opposite = 2 * theta - std::copysign(pi, theta);
      const double on_circle =
          dilogarithm_imaginary({-cosine, -sine}, {0, opposite}, {0.5 * (ln_4 + 2 * std::log(p)) - 0.5 * ln_R2, theta});
      const double inside = dilogarithm_imaginary({-b * cosine, -b * sine}, {ln_b, opposite},
                                                  {0.5 * (ln_4 + ln_b_p2_h2 + end.ln_r2 - ln_R2), theta - angle});
      return -theta * ln_b + on_circle - inside;
    }
  };

  double sine_, h_, ln_h2_;
};

/// Where the common perpendicular of two lines stands, along either from its edge's first corner, and how long it is.
struct Feet {
  double on_e, on_f, h;
  double error = 0;  ///< of their places, times sine
};
Feet feet_of(const Edge& e, const Edge& f, const Vec3& across, const std::array<std::array<Vec3, 2>, 2>& from_f_to_e) {
  for (std::size_t j = 0; j < 2; ++j)
    for (std::size_t k = 0; k < 2; ++k)
      if (from_f_to_e[j][k].squaredNorm() <= one_corner * one_corner)
        return {j == 1 ? e.length : 0.0, k == 1 ? f.length : 0.0, 0.0, 0.0};
  const Vec3& w = from_f_to_e[0][0];
  const double square = across.squaredNorm();
  return {-accurate_cross(w, f.along).dot(across) / square * e.length,
          -accurate_cross(w, e.along).dot(across) / square * f.length, std::abs(w.dot(across)) / std::sqrt(square),
          rounding * w.norm()};
}

/// int int ln r ds dt
Integral skew_edges(const Edge& e, const Edge& f, const Vec3& across, double sine) {
  const std::array<std::array<Vec3, 2>, 2> w = {{{e.from - f.from, e.from - f.to}, {e.to - f.from, e.to - f.to}}};
  const Feet feet = feet_of(e, f, across, w);
  const SkewLines lines(sine, feet.h);
  const auto end = [&](std::size_t j, std::size_t k, double u) {
    const double r2 = w[j][k].squaredNorm();
    return End{u, std::sqrt(r2), r2 > 0.0 ? std::log(r2) : 0.0};
  };
  SizedSum sum;
  for (std::size_t j = 0; j < 2; ++j) {
    const double sign = j == 1 ? 1.0 : -1.0, S = (j == 1 ? e.length : 0.0) - feet.on_e,
                 T = (j == 1 ? f.length : 0.0) - feet.on_f;
    lines.add_side(sign * S, end(j, 0, -w[j][0].dot(f.direction)), end(j, 1, -w[j][1].dot(f.direction)), sum);
    lines.add_side(sign * T, end(0, j, w[0][j].dot(e.direction)), end(1, j, w[1][j].dot(e.direction)), sum);
  }
  // A foot that moves along takes from one side what it gives to the one across: about its length.
  return {sum.value, rounding * sum.size + feet.error / sine * (e.length + f.length)};
}

}  // namespace

Edge edge_between(const Vec3& from, const Vec3& to) {
  const Vec3 along = to - from;
  const double length = along.norm();
  return {from, to, along, length > 0.0 ? Vec3(along / length) : Vec3::Zero(), length};
}

Integral edge_pair(const Edge& e, const Edge& f) {
  const double lengths = e.length * f.length;
  if (!(lengths > 0.0)) return {};
  const double c = e.along.dot(f.along) / lengths;
  if (std::abs(c) <= 4 * rounding) return {0.0, 4 * rounding * lengths};
  const Vec3 across = accurate_cross(e.along, f.along);
  const double sine = across.norm() / lengths;
  const Integral integral = sine <= parallel_sine ? parallel_edges(e, f, sine) : skew_edges(e, f, across, sine);
  return {c * integral.value, std::abs(c) * (integral.error + 4 * rounding * std::abs(integral.value))};
}

}  // namespace interflect::fem
