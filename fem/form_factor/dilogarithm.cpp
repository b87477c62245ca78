#include "fem/form_factor/dilogarithm.h"

#include <array>
#include <cmath>
#include <numbers>

namespace interflect::fem {

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

/// B_{2k} / (2k + 1)!, k = 10 .. 1.
constexpr std::array<double, 10> even_terms = {
    -1.035651761218124701e-17, 4.518980029619918192e-16, -1.993929586072107569e-14, 8.921691020456452555e-13,
    -4.064761645144225527e-11, 1.897886998897099907e-9,  -9.185773074661963551e-8,  4.724111866969009826e-6,
    -2.777777777777777778e-4,  2.777777777777777778e-2};

/// Without the checks for infinities that C's complex product makes.
Complex product(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// Li2(1 - exp(-u)) = u - u²/4 + sum_k B_{2k} u^{2k+1} / (2k+1)!, |u| <= pi/3.
///
/// A real polynomial at w = u² by Horner's rule over w's quadratic, x² = 2 Re(w) x - |w|²: half the products of complex
/// arithmetic.
Complex bernoulli_series(Complex u) {
  const Complex w = product(u, u);
  const double sum = 2 * w.real(), square = w.real() * w.real() + w.imag() * w.imag();
  double high = even_terms[0], low = even_terms[1];
  for (std::size_t k = 2; k < even_terms.size(); ++k) {
    const double carried = high;
    high = low + sum * carried;
    low = even_terms[k] - square * carried;
  }
  const Complex odd = {low + high * w.real(), high * w.imag()};
  return u - 0.25 * w + product(product(u, w), odd);
}

/// |z| <= 1, Re z <= 1/2.
Complex in_the_left(Complex z) {
  // ln(1 - z) = ln|1 - z|² / 2 + i arg; log1p keeps small z.
  const double x = z.real(), y = z.imag();
  return bernoulli_series({-0.5 * std::log1p(x * (x - 2) + y * y), std::atan2(y, 1 - x)});
}

/// |z| <= 1.
Complex in_the_disc(Complex z) {
  if (z.real() <= 0.5) return in_the_left(z);
  if (z == 1.0) return pi * pi / 6;
  const Complex rest = 1.0 - z;
  return pi * pi / 6 - product(std::log(z), std::log(rest)) - in_the_left(rest);
}

}  // namespace

Complex dilogarithm(Complex z) {
  if (std::norm(z) <= 1.0) return in_the_disc(z);
  if (z.imag() == 0.0) z.imag(z.real() > 0.0 ? -0.0 : 0.0);
  const Complex log = std::log(-z);
  return -pi * pi / 6 - 0.5 * product(log, log) - in_the_disc(1.0 / z);
}

double dilogarithm_imaginary(Complex z, Complex log_z, Complex log_1_minus_z) {
  if (z.real() <= 0.5) return bernoulli_series(-log_1_minus_z).imag();
  return -product(log_z, log_1_minus_z).imag() - bernoulli_series(-log_z).imag();
}

}  // namespace interflect::fem
