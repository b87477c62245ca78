#pragma once

#include "fem/kernel.h"
#include "fem/space/space.h"
#include "solvers/transport_operator.h"

namespace interflect::fem {

/// Point collocation: the equation holds at as many nodes of a panel as it has functions, and unknowns are the values
/// there,
///
///   b_a = e_a + rho_a sum_b T_ab b_b,    T_ab = int k(x_a, y) l_b(y) dy,    l_b(x_a) = delta_ab
///
/// with the Lagrange polynomials l_b of the nodes.  G is the identity; T is not symmetric.
class Collocation final : public solvers::TransportOperator, public solvers::RowAccess {
 public:
  /// Nodes at the Gauss points of segments.
  /// @param points  of the inner integrals, by Gauss rules
  Collocation(const Space& space, const Kernel& kernel, int points, Run& run);

  const solvers::Layout& layout() const override { return space_.layout(); }
  bool symmetric() const override { return false; }
  void apply(solvers::ConstColumns b, solvers::Columns out, Run& run) const override;
  std::span<const double> gram() const override { return ones_; }
  std::span<const double> self() const override { return self_; }
  const solvers::RowAccess* rows() const override { return this; }
  void rows(Index first, Index count, solvers::Columns out) const override;
  Index evaluated() const override { return 0; }

  const Vec3& node(Index unknown) const { return nodes_[static_cast<std::size_t>(unknown)]; }
  /// Values at the nodes of a panel to its coefficients in the space, and of all panels.
  Eigen::VectorXd coefficients(const Eigen::VectorXd& at_nodes) const;

 private:
  const Space& space_;
  std::vector<Vec3> nodes_;
  std::vector<Eigen::MatrixXd> to_coefficients_;  ///< of each panel: the inverse of N_a at its nodes
  solvers::ColumnMatrix T_;
  std::vector<double> ones_, self_;
};

}  // namespace interflect::fem
