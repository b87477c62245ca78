#include "fem/polynomial_radiosity.h"

#include "fem/columns.h"
#include "fem/space/polynomials.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;

/// Values of elements on their functions `first` .. `end`, 0 on all others.
ColumnMatrix on_functions(std::span<const Spectrum> values, int channels, Index functions, Index end) {
  const ColumnMatrix of_elements = to_columns(values, channels);
  ColumnMatrix out = ColumnMatrix::Zero(of_elements.rows() * functions, channels);
  for (Index i = 0; i < of_elements.rows(); ++i)
    for (Index a = 0; a < end; ++a) out.row(i * functions + a) = of_elements.row(i);
  return out;
}

std::vector<Spectrum> means(const ColumnMatrix& coefficients, Index functions) {
  ColumnMatrix first(coefficients.rows() / functions, coefficients.cols());
  for (Index i = 0; i < first.rows(); ++i) first.row(i) = coefficients.row(i * functions);
  return to_spectra(first);
}

struct Fields {
  ColumnMatrix radiosity, irradiance;
  solvers::SolverReport report;
};

/// With the functions up to a degree alone.
Fields solved(const RadiositySolution& s, const SymmetricOperator& K, int degree, Index functions,
              const RadiositySettings& settings, int channels, Run& run) {
  const solvers::Reflection R(on_functions(s.reflectance, channels, functions, plane_functions(degree)));
  const ColumnMatrix e = on_functions(s.exitance, channels, functions, 1);
  solvers::SolverState state{e, 0};
  Fields fields;
  fields.report = solvers::make_solver(settings.solver)->advance({K, R, e}, state, settings.stopping, run);
  run.throw_if_stopped("solve");
  fields.radiosity = std::move(state.x);
  fields.irradiance.resize(e.rows(), e.cols());
  K.apply(fields.radiosity, fields.irradiance, run);
  divide_by(fields.irradiance, K.gram());
  return fields;
}

/// Root mean square of the functions of the highest degree.
Spectrum highest_degree(const ColumnMatrix& coefficients, Index element, int order, Index functions) {
  Spectrum squares;
  for (Index a = plane_functions(order - 1); a < functions; ++a)
    for (int c = 0; c < coefficients.cols(); ++c) {
      const double value = coefficients(element * functions + a, c);
      squares[c] += value * value;
    }
  return sqrt(squares);
}

}  // namespace

PolynomialChange solve_polynomials(RadiositySolution& s, const SymmetricOperator& blocks,
                                   const RadiositySettings& settings, int channels, Run& run) {
  const Index functions = plane_functions(settings.order);
  const Fields fields = solved(s, blocks, settings.order, functions, settings, channels, run),
               below = solved(s, blocks, settings.order - 1, functions, settings, channels, run);
  s.solver = fields.report;
  s.radiosity = means(fields.radiosity, functions);
  s.irradiance = means(fields.irradiance, functions);
  s.coarse_radiosity = means(below.radiosity, functions);
  s.field = PolynomialField{settings.order, functions, {}, fields.radiosity, fields.irradiance, below.radiosity};
  for (const scene::SurfacePatch& patch : s.mesh.patches())
    s.field->bases.emplace_back(settings.order, patch.ring(), patch.normal());
  PolynomialChange change{fields.report.converged() && below.report.converged(), {}, {}};
  change.mean_irradiance = to_spectra(
      (to_columns(s.irradiance, channels) - to_columns(means(below.irradiance, functions), channels)).cwiseAbs());
  for (Index i = 0; i < static_cast<Index>(s.mesh.size()); ++i)
    change.variation.push_back(highest_degree(fields.irradiance, i, settings.order, functions));
  return change;
}

}  // namespace interflect::fem
