#pragma once

#include <span>
#include <vector>

#include "core/spectrum.h"
#include "fem/space/plane_basis.h"
#include "scene/place.h"
#include "solvers/transport_operator.h"

namespace interflect::fem {

/// Radiosity as polynomials on elements, beside the constants of a RadiositySolution, which become their means.
///
///   B_h(x) = sum_a c_a N_a(x),    c = e + R G^-1 K c       (e: exitance, constant on elements)
///
/// Functions go by degree, so that the solution of the order below is that of the same equations in which functions of
/// the highest degree neither reflect nor emit: the difference of both is what errors are estimated from.
struct PolynomialField {
  int order;
  Index functions;                        ///< of an element
  std::vector<int> degree;                ///< of elements, <= order: what their highest function with a coefficient has
  std::vector<PlaneBasis> bases;          ///< of elements
  solvers::ColumnMatrix radiosity;        ///< c: unknowns x channels
  solvers::ColumnMatrix irradiance;       ///< G^-1 K c
  solvers::ColumnMatrix radiosity_below;  ///< of the order below, on the same functions
  solvers::ColumnMatrix irradiance_noise{};  ///< standard errors of irradiance's that were sampled by rays; else empty

  /// B_h at a point of an element.
  Spectrum at(std::size_t element, const Vec3& x) const { return value(radiosity, element, x); }
  Spectrum irradiance_at(std::size_t element, const Vec3& x) const { return value(irradiance, element, x); }
  /// Of it, what is not of the order below.
  Spectrum added_at(std::size_t element, const Vec3& x) const {
    return at(element, x) - value(radiosity_below, element, x);
  }
  /// Standard error of irradiance at a point that sampled coefficients have, sum_a |N_a| of theirs: no less than true,
  /// however they are correlated, as they are where light falls on one end of an element.  0 where none were sampled.
  Spectrum noise_at(std::size_t element, const Vec3& x) const;
  /// Root mean square of irradiance in an element about its mean.
  Spectrum irradiance_variation(std::size_t element) const;
  /// sum_a w_a c_a of an element: w are what its functions are worth.
  static Spectrum weighed(const solvers::ColumnMatrix& coefficients, Index first, std::span<const double> w);
  /// sum_a |c_a| of an element's.
  static Spectrum sizes(const solvers::ColumnMatrix& coefficients, Index first, Index functions);
  /// sum_a |w_a c_a|.
  static Spectrum at_most(const solvers::ColumnMatrix& coefficients, Index first, std::span<const double> w);
  /// sqrt(sum c_a²) of functions of one degree: their root mean square on an element.
  static Spectrum of_degree(int degree, const solvers::ColumnMatrix& coefficients, Index first);
  /// Of elements: coefficients of their first functions.
  static std::vector<Spectrum> means(const solvers::ColumnMatrix& coefficients, Index functions);

 private:
  Spectrum value(const solvers::ColumnMatrix& coefficients, std::size_t element, const Vec3& x) const;
};

/// The functions of elements.
std::vector<PlaneBasis> bases_of(int order, std::span<const scene::SurfacePatch> patches);

}  // namespace interflect::fem
