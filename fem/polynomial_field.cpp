#include "fem/polynomial_field.h"

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
