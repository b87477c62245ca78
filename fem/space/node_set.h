#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "fem/space/space.h"
#include "mesh/element_mesh.h"

namespace interflect::fem {

/// Nodes whose values are unknowns in place of coefficients, and the field that values there stand for:
///
///   c = P v,    f_h = sum_a c_a N_a       P: the space's unknowns x nodes, sparse
///
/// A constant stays what it is.
struct NodeSet {
  using Prolongation = Eigen::SparseMatrix<double, Eigen::RowMajor, Index>;

  std::vector<Vec3> position;
  std::vector<Index> panel;  ///< that a node lies on; of those that share it, one
  Prolongation P;

  Index size() const { return std::ssize(position); }
};

/// Gauss nodes of each panel, so many that the discrete projection c_a = 1/A sum_q w_q N_a(x_q) v_q is that of L2 for
/// all of the space: order + 1 on segments, order + 1 across a quad, 1, 3, 6 or 12 on triangles.  On segments, and on
/// triangles of order 1 and 2, it goes through the values.  Of order 0: the middles of elements' corners.
NodeSet gauss_nodes(const Space& space);

/// Both ends of segments, and Lobatto's points between them: as many as functions.
/// @throws core::PreconditionError  another panel; order 0
NodeSet end_nodes(const Space& space);

/// Corners of elements, of a field that is continuous over each side of a surface: linear on triangles, bilinear on
/// quads.  Corners that hang follow their edge's ends (mesh/shared_corners.h).
///
/// The space holds linear functions from order 1 on, and bilinear ones of parallelograms from order 2; what it does not
/// hold is projected.  Nodes lie 1e-5 of the way to the middle of an element, since on edges where walls meet
/// irradiance has no value of its own but one from either side.
/// @param space  on the mesh's patches, of an order from 1 on
NodeSet corner_nodes(const Space& space, const mesh::ElementMesh& mesh);

}  // namespace interflect::fem
