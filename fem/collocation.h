#pragma once

#include <atomic>
#include <cstdint>

#include "fem/kernel.h"
#include "fem/space/space.h"
#include "solvers/transport_operator.h"

namespace interflect::fem {

/// Where the equation holds on a panel.
enum class CollocationNodes : std::uint8_t {
  gauss_points,  ///< one: the centroid; with order + 1 of them values there gain orders (docs/finite_elements.md)
  vertices       ///< both ends, and Lobatto's points between them; order 1 or more
};

/// Point collocation: the equation holds at as many nodes of a panel as it has functions, and unknowns are the values
/// there,
///
///   b_a = e_a + rho_a sum_b T_ab b_b,    T_ab = int k(x_a, y) l_b(y) dy,    l_b(x_a) = delta_ab
///
/// with the Lagrange polynomials l_b of the nodes.  G is the identity; T is not symmetric.
class Collocation final : public solvers::TransportOperator, public solvers::RowAccess {
 public:
  /// @param points  of the inner integrals, by Gauss rules
  /// @throws core::PreconditionError  panels that are no segments; vertices with order 0
  Collocation(const Space& space, CollocationNodes nodes, const Kernel& kernel, int points, Run& run);

  const solvers::Layout& layout() const override { return space_.layout(); }
  bool symmetric() const override { return false; }
  void apply(solvers::ConstColumns b, solvers::Columns out, Run& run) const override;
  std::span<const double> gram() const override { return ones_; }
  std::span<const double> self() const override { return self_; }
  const solvers::RowAccess* rows() const override { return this; }
  void rows(Index first, Index count, solvers::Columns out) const override;
  Index evaluated() const override { return evaluated_.load(std::memory_order_relaxed); }

  const Vec3& node(Index unknown) const { return nodes_[static_cast<std::size_t>(unknown)]; }
  /// Values at the nodes of a panel to its coefficients in the space, and of all panels.
  Eigen::VectorXd coefficients(const Eigen::VectorXd& at_nodes) const;

 private:
  const Space& space_;
  std::vector<Vec3> nodes_;
  std::vector<Eigen::MatrixXd> to_coefficients_;  ///< of each panel: the inverse of N_a at its nodes
  solvers::ColumnMatrix T_;
  std::vector<double> ones_, self_;
  mutable std::atomic<Index> evaluated_{0};
};

}  // namespace interflect::fem
