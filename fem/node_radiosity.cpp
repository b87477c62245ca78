#include "fem/node_radiosity.h"

#include "core/error.h"
#include "fem/collocation.h"
#include "fem/continuous.h"
#include "fem/element_materials.h"

namespace interflect::fem {
using solvers::ColumnMatrix;

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
  const auto [e, reflectance] = at_nodes(s.exitance, s.reflectance, channels, nodes);
  const solvers::Reflection R(reflectance);
  solvers::SolverState state{e};
  solvers::SolverReport report = solver_of(settings)->advance({T, R, e}, state, settings.stopping, run);
  Run rest = run.to_the_end();  // a solve that is stopped ends with what it has
  ColumnMatrix H(e.rows(), e.cols());
  T.apply(state.x, H, rest);
  return {nodes.P * state.x, nodes.P * H, std::move(report)};
}

}  // namespace interflect::fem
