#include "fem/node_radiosity.h"

#include "core/error.h"
#include "fem/collocation.h"
#include "fem/columns.h"
#include "fem/continuous.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;

/// Values of elements at their nodes.
ColumnMatrix at_nodes(const NodeSet& nodes, std::span<const Spectrum> of_elements, int channels) {
  const ColumnMatrix values = to_columns(of_elements, channels);
  ColumnMatrix out(nodes.size(), channels);
  for (Index k = 0; k < out.rows(); ++k) out.row(k) = values.row(nodes.panel[static_cast<std::size_t>(k)]);
  return out;
}

}  // namespace

NodeEquations node_equations(Projection projection, const scene::Scene& scene, const mesh::ElementMesh& mesh, int order,
                             const SymmetricOperator& K, Run& run) {
  if (projection == Projection::galerkin) throw core::PreconditionError("node_equations: Galerkin's have no nodes");
  const Space space = space_on(mesh.patches(), order);
  NodeSet nodes = at_corners(projection) ? corner_nodes(space, mesh) : gauss_nodes(space);
  if (projection == Projection::continuous) {
    NodeOperator T = continuous_galerkin(K, nodes, run);
    return {std::move(nodes), std::move(T)};
  }
  NodeOperator T = collocation(nodes, PointViewFactors(scene, mesh.patches(), order), mesh.patches(), run);
  return {std::move(nodes), std::move(T)};
}

ElementFields solve_at_nodes(const NodeEquations& equations, const RadiositySolution& s,
                             const RadiositySettings& settings, int channels, Run& run) {
  const auto& [nodes, T] = equations;
  const solvers::Reflection R(at_nodes(nodes, s.reflectance, channels));
  const ColumnMatrix e = at_nodes(nodes, s.exitance, channels);
  solvers::SolverState state{e, 0};
  solvers::SolverReport report =
      solvers::make_solver(settings.solver)->advance({T, R, e}, state, settings.stopping, run);
  run.throw_if_stopped("solve");
  ColumnMatrix H(e.rows(), e.cols());
  T.apply(state.x, H, run);
  return {nodes.P * state.x, nodes.P * H, std::move(report)};
}

}  // namespace interflect::fem
