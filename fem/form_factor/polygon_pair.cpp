#include "fem/form_factor/polygon_pair.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fem/form_factor/contour.h"
#include "fem/form_factor/edge_pair.h"
#include "fem/form_factor/scaled_rings.h"

namespace interflect::fem {

namespace {

struct Term {
  const Edge *e, *f;
  Integral integral;
  bool by_quadrature = false;

  friend bool operator<(const Term& a, const Term& b) { return a.integral.error < b.integral.error; }
};

/// Errors of rounding, one pair's independent of another's, add as their squares.
Integral sum_of(std::span<const Term> terms) {
  double value = 0, squares = 0;
  for (const Term& term : terms) {
    value += term.integral.value;
    squares += term.integral.error * term.integral.error;
  }
  return {value, std::sqrt(squares)};
}

}  // namespace

Integral polygon_pair(std::span<const Vec3> a, std::span<const Vec3> b, double tolerance) {
  const ScaledRings rings(a, b);
  std::vector<Term> terms;
  terms.reserve(a.size() * b.size());
  for (const Edge& e : rings.edges_of_a())
    for (const Edge& f : rings.edges_of_b()) terms.push_back({&e, &f, edge_pair(e, f)});
  Integral sum = sum_of(terms);
  while (sum.error > tolerance * sum.value) {
    Term& worst = *std::max_element(terms.begin(), terms.end());
    if (worst.by_quadrature) break;
    if (const Integral other = edge_pair_by_quadrature(*worst.e, *worst.f); other.error < worst.integral.error)
      worst.integral = other;
    worst.by_quadrature = true;
    sum = sum_of(terms);
  }
  return rings.to_square_metres(sum);
}

}  // namespace interflect::fem
