#include "fem/form_factor/contour.h"

#include <array>
#include <cmath>
#include <limits>

#include "fem/form_factor/scaled_rings.h"
#include "fem/quadrature.h"

namespace interflect::fem {

namespace {

constexpr double rounding = 0.5 * std::numeric_limits<double>::epsilon();
constexpr int most_halvings = 30;

/// A point of the complex s plane, and its mirror image in the real axis.
struct Singularity {
  double real, imaginary;
};

/// J(s) and where it is singular.
class InnerIntegral {
 public:
  InnerIntegral(const Edge& e, const Edge& f) : e_(e), f_(f) {
    const Vec3 across = e.direction.cross(f.direction), w = e.from - f.from;
    const double square = across.squaredNorm();
    for (const Vec3* Q : {&f.from, &f.to}) add_end(*Q - e.from);
    // Where the lines are parallel to rounding, m is constant to rounding.
    if (square > rounding * rounding)
      singular_[2] = {-w.cross(f.direction).dot(across) / square, std::abs(w.dot(across)) / square};
  }

  SizedSum operator()(double s) const {
    const Vec3 x = (e_.from - f_.from) + s * e_.direction;
    const double v = -x.dot(f_.direction);
    const double m = x.cross(f_.direction).norm();
    const double high = primitive(v + f_.length, m), low = primitive(v, m);
    return {high - low, std::abs(high) + std::abs(low) + m};  // the direction of f is rounded, and m with it
  }
  bool smooth_on(double middle, double half) const {
    for (const Singularity& at : singular_)
      if (std::hypot(at.real - middle, at.imaginary) < 3 * half * (1 - 1e-9)) return false;
    return true;
  }

 private:
  void add_end(const Vec3& Q) {
    const double s = Q.dot(e_.direction);
    singular_[ends_++] = {s, Q.cross(e_.direction).norm()};
  }
  static double primitive(double v, double m) {
    const double r2 = v * v + m * m;
    return (r2 > 0.0 ? v * (0.5 * std::log(r2) - 1) : 0.0) + (m > 0.0 ? m * std::atan(v / m) : 0.0);
  }

  const Edge &e_, &f_;
  std::size_t ends_ = 0;
  std::array<Singularity, 3> singular_{{{0, 0}, {0, 0}, {std::numeric_limits<double>::infinity(), 0}}};
};

const Rule& ten_points() {
  static const Rule rule = gauss_legendre(10);
  return rule;
}

SizedSum integral_over(const InnerIntegral& J, double from, double to, int halvings) {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  if (halvings < most_halvings && !J.smooth_on(middle, half)) {
    const SizedSum low = integral_over(J, from, middle, halvings + 1),
                   high = integral_over(J, middle, to, halvings + 1);
    return {low.value + high.value, low.size + high.size};
  }
  SizedSum sum;
  for (const RuleNode& node : ten_points()) {
    const SizedSum inner = J(from + node.u * (to - from));
    sum.value += node.weight * (to - from) * inner.value;
    sum.size += node.weight * (to - from) * inner.size;
  }
  return sum;
}

}  // namespace

Integral edge_pair_by_quadrature(const Edge& e, const Edge& f) {
  const double lengths = e.length * f.length;
  if (!(lengths > 0.0)) return {};
  const double c = e.along.dot(f.along) / lengths;
  if ((e.from == f.to && e.to == f.from) || (e.from == f.from && e.to == f.to))
    return {c * lengths * (std::log(e.length) - 1.5), 2 * rounding * lengths};
  const SizedSum integral = integral_over(InnerIntegral(e, f), 0, e.length, 0);
  return {c * integral.value, rounding * std::abs(c) * integral.size};
}

Integral double_contour(std::span<const Vec3> a, std::span<const Vec3> b) {
  const ScaledRings rings(a, b);
  double value = 0, squares = 0;
  for (const Edge& e : rings.edges_of_a())
    for (const Edge& f : rings.edges_of_b()) {
      const Integral term = edge_pair_by_quadrature(e, f);
      value += term.value;
      squares += term.error * term.error;  // of rounding, one pair's independent of another's
    }
  return rings.to_square_metres({value, std::sqrt(squares)});
}

}  // namespace interflect::fem
