#pragma once

#include <vector>

#include "core/error.h"
#include "solvers/transport_operator.h"

namespace interflect::fem {

/// What solvers that sample have of K: the areas of elements with constants.  There is no matrix, and no product with
/// it.
class AreasAlone final : public solvers::TransportOperator {
 public:
  explicit AreasAlone(std::vector<double> areas)
      : layout_(solvers::Layout::uniform(static_cast<Index>(areas.size()), 1)),
        areas_(std::move(areas)),
        self_(areas_.size(), 0.0) {}
  const solvers::Layout& layout() const override { return layout_; }
  bool symmetric() const override { return true; }  // A_i F_ij = A_j F_ji, by rays as well
  void apply(solvers::ConstColumns, solvers::Columns, Run&) const override {
    throw core::PreconditionError("areas alone: there is no matrix to multiply by");
  }
  std::span<const double> gram() const override { return areas_; }
  std::span<const double> self() const override { return self_; }

 private:
  solvers::Layout layout_;
  std::vector<double> areas_, self_;
};

}  // namespace interflect::fem
