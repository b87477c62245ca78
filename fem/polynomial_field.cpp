#include "fem/polynomial_field.h"

#include <cmath>

#include "fem/columns.h"
#include "fem/space/polynomials.h"

namespace interflect::fem {

Spectrum PolynomialField::weighed(const solvers::ColumnMatrix& coefficients, Index first, std::span<const double> w) {
  Spectrum sum;
  for (std::size_t a = 0; a < w.size(); ++a)
    for (int c = 0; c < coefficients.cols(); ++c) sum[c] += w[a] * coefficients(first + static_cast<Index>(a), c);
  return sum;
}

Spectrum PolynomialField::sizes(const solvers::ColumnMatrix& coefficients, Index first, Index functions) {
  Spectrum sum;
  for (int c = 0; c < coefficients.cols(); ++c) sum[c] = coefficients.col(c).segment(first, functions).cwiseAbs().sum();
  return sum;
}

Spectrum PolynomialField::at_most(const solvers::ColumnMatrix& coefficients, Index first, std::span<const double> w) {
  Spectrum sum;
  for (std::size_t a = 0; a < w.size(); ++a)
    for (int c = 0; c < coefficients.cols(); ++c)
      sum[c] += std::abs(w[a] * coefficients(first + static_cast<Index>(a), c));
  return sum;
}

Spectrum PolynomialField::of_degree(int degree, const solvers::ColumnMatrix& coefficients, Index first) {
  const Index below = degree > 0 ? plane_functions(degree - 1) : 0, functions = plane_functions(degree);
  Spectrum sizes;
  for (int c = 0; c < coefficients.cols(); ++c)
    sizes[c] = coefficients.col(c).segment(first + below, functions - below).norm();
  return sizes;
}

std::vector<Spectrum> PolynomialField::means(const solvers::ColumnMatrix& coefficients, Index functions) {
  solvers::ColumnMatrix first(coefficients.rows() / functions, coefficients.cols());
  for (Index i = 0; i < first.rows(); ++i) first.row(i) = coefficients.row(i * functions);
  return to_spectra(first);
}

std::vector<PlaneBasis> bases_of(int order, std::span<const scene::SurfacePatch> patches) {
  std::vector<PlaneBasis> bases;
  bases.reserve(patches.size());
  for (const scene::SurfacePatch& patch : patches) bases.emplace_back(order, patch.ring(), patch.normal());
  return bases;
}

Spectrum PolynomialField::noise_at(std::size_t element, const Vec3& x) const {
  if (irradiance_noise.size() == 0) return Spectrum::zero();
  const PlaneBasis::Values N = bases[element].at(x);
  return at_most(irradiance_noise, static_cast<Index>(element) * functions,
                 {N.data(), static_cast<std::size_t>(functions)});
}

Spectrum PolynomialField::value(const solvers::ColumnMatrix& coefficients, std::size_t element, const Vec3& x) const {
  const PlaneBasis::Values N = bases[element].at(x);
  return weighed(coefficients, static_cast<Index>(element) * functions,
                 {N.data(), static_cast<std::size_t>(functions)});
}

Spectrum PolynomialField::irradiance_variation(std::size_t element) const {
  Spectrum squares;
  for (Index a = 1; a < functions; ++a)
    for (int c = 0; c < irradiance.cols(); ++c) {
      const double h = irradiance(static_cast<Index>(element) * functions + a, c);
      squares[c] += h * h;
    }
  return sqrt(squares);
}

}  // namespace interflect::fem
