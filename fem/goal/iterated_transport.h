#pragma once

#include <vector>

#include "fem/point_view_factors.h"
#include "fem/quadrature.h"
#include "solvers/transport_operator.h"

namespace interflect::fem {

/// Nodes of Gauss rules on all elements.
struct ElementNodes {
  std::vector<SurfaceNode> nodes;
  std::vector<std::size_t> first;  ///< of each element, and the end: elements + 1

  std::size_t size() const { return nodes.size(); }
};
/// @param points  across an element, 1 .. 4 (rules_of)
ElementNodes element_nodes(std::span<const scene::SurfacePatch> patches, int points);

/// (T b)(x) = int k(x, y) b(y) dy at every node, of polynomials b on elements: what Sloan's iteration E + rho T b
/// needs, past whatever hides, and as accurate as `factors` are (point_view_factors.h).
///
/// @param b  unknowns of `factors`, element after element, x columns
/// @return   nodes x columns
/// @throws core::Interrupted
solvers::ColumnMatrix iterated_transport(const PointViewFactors& factors, std::span<const scene::SurfacePatch> patches,
                                         const ElementNodes& nodes, solvers::ConstColumns b, Run& run);

}  // namespace interflect::fem
