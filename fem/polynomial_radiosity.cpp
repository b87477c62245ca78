#include "fem/polynomial_radiosity.h"

#include "fem/columns.h"
#include "fem/element_materials.h"
#include "fem/node_radiosity.h"
#include "fem/space/polynomials.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;

/// With the functions up to a degree of each element alone.
ElementFields solved(const RadiositySolution& s, const SymmetricOperator& K, std::span<const int> degree,
                     Index functions, const RadiositySettings& settings, int channels, Run& run) {
  const auto [e, reflectance] = on_functions(s.exitance, s.reflectance, channels, degree, functions);
  const solvers::Reflection R(reflectance);
  solvers::SolverState state{e};
  ElementFields fields;
  fields.report = solver_of(settings)->advance({K, R, e}, state, settings.stopping, run);
  Run rest = run.to_the_end();  // a solve that is stopped ends with what it has
  fields.radiosity = std::move(state.x);
  fields.irradiance.resize(e.rows(), e.cols());
  K.apply(fields.radiosity, fields.irradiance, rest);
  divide_by(fields.irradiance, K.gram());
  for (Index i = 0; i < std::ssize(degree); ++i) {
    const Index active = plane_functions(degree[static_cast<std::size_t>(i)]);
    fields.irradiance.middleRows(i * functions + active, functions - active).setZero();
  }
  return fields;
}

}  // namespace

PolynomialChange solve_polynomials(RadiositySolution& s, const scene::Scene& scene, const SymmetricOperator& blocks,
                                   std::span<const int> given, const RadiositySettings& settings, Run& run) {
  const int channels = scene.channel_count(), order = settings.order;
  const Index functions = plane_functions(order);
  const bool linear = at_corners(settings.projection);
  std::vector<int> degree(given.begin(), given.end());
  if (degree.empty()) degree.assign(s.mesh.patches().size(), linear ? 1 : order);
  std::vector<int> lower = degree;
  for (int& p : lower) --p;
  const ElementFields below = solved(s, blocks, lower, functions, settings, channels, run),
                      fields =
                          settings.projection == Projection::galerkin
                              ? solved(s, blocks, degree, functions, settings, channels, run)
                              : solve_at_nodes(node_equations(settings.projection, scene, s.mesh, order, blocks, run),
                                               s, settings, channels, run);
  s.solver = fields.report;
  s.radiosity = PolynomialField::means(fields.radiosity, functions);
  s.irradiance = PolynomialField::means(fields.irradiance, functions);
  s.coarse_radiosity = PolynomialField::means(below.radiosity, functions);
  s.field = PolynomialField{order,
                            functions,
                            linear ? std::vector<int>(degree.size(), order) : degree,
                            bases_of(order, s.mesh.patches()),
                            fields.radiosity,
                            fields.irradiance,
                            below.radiosity};
  PolynomialChange change{fields.report.converged() && below.report.converged(), {}, {}};
  change.mean_irradiance = to_spectra(
      (to_columns(s.irradiance, channels) - to_columns(PolynomialField::means(below.irradiance, functions), channels))
          .cwiseAbs());
  for (Index i = 0; i < static_cast<Index>(s.mesh.size()); ++i)
    change.variation.push_back(
        PolynomialField::of_degree(degree[static_cast<std::size_t>(i)], fields.irradiance, i * functions));
  return change;
}

}  // namespace interflect::fem
