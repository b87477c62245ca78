#pragma once

#include "fem/operator/node_operator.h"
#include "fem/operator/symmetric_operator.h"
#include "fem/projection.h"
#include "fem/radiosity.h"
#include "fem/space/node_set.h"

namespace interflect::fem {

/// Equations whose unknowns are values at nodes of a scene's elements.
struct NodeEquations {
  NodeSet nodes;
  NodeOperator T;
};
/// @param projection  any but Galerkin's
/// @param order       of the polynomials that values stand for
/// @param K           of those polynomials
NodeEquations node_equations(Projection projection, const scene::Scene& scene, const mesh::ElementMesh& mesh, int order,
                             const SymmetricOperator& K, Run& run);

/// Coefficients of radiosity and irradiance on elements, unknowns x channels.
struct ElementFields {
  solvers::ColumnMatrix radiosity, irradiance;
  solvers::SolverReport report;
};
/// @param s  whose exitance and reflectance are known
ElementFields solve_at_nodes(const NodeEquations& equations, const RadiositySolution& s,
                             const RadiositySettings& settings, int channels, Run& run);

}  // namespace interflect::fem
