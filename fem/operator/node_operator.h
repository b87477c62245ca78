#pragma once

#include <atomic>
#include <vector>

#include "solvers/transport_operator.h"

namespace interflect::fem {

/// T between values at nodes, whole and in doubles:
///
///   b_a = e_a + rho_a sum_b T_ab b_b,   G the identity, T without units and not symmetric
class NodeOperator final : public solvers::TransportOperator, public solvers::RowAccess {
 public:
  /// @param T  square
  explicit NodeOperator(solvers::ColumnMatrix T);
  NodeOperator(NodeOperator&& other) noexcept
      : T_(std::move(other.T_)),
        layout_(std::move(other.layout_)),
        ones_(std::move(other.ones_)),
        self_(std::move(other.self_)),
        evaluated_(other.evaluated_.load(std::memory_order_relaxed)) {}

  const solvers::Layout& layout() const override { return layout_; }
  bool symmetric() const override { return false; }
  /// Same bits for any number of threads.
  void apply(solvers::ConstColumns b, solvers::Columns out, Run& run) const override;
  std::span<const double> gram() const override { return ones_; }
  std::span<const double> self() const override { return self_; }
  const solvers::RowAccess* rows() const override { return this; }
  void rows(Index first, Index count, solvers::Columns out) const override;
  Index evaluated() const override { return evaluated_.load(std::memory_order_relaxed); }

 private:
  solvers::ColumnMatrix T_;
  solvers::Layout layout_;
  std::vector<double> ones_, self_;
  mutable std::atomic<Index> evaluated_{0};
};

}  // namespace interflect::fem
