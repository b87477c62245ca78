#pragma once

#include <vector>

#include "core/error.h"
#include "solvers/transport_operator.h"

namespace interflect::fem {

/// What solvers that sample have of K: the areas of elements, which is what functions that are orthonormal in the mean
/// have for G.  There is no matrix, and no product with it.
class AreasAlone final : public solvers::TransportOperator {
 public:
  /// @param functions  of an element
  explicit AreasAlone(std::span<const double> areas, Index functions = 1)
      : layout_(solvers::Layout::uniform(static_cast<Index>(areas.size()), functions)) {
    for (const double area : areas) gram_.insert(gram_.end(), static_cast<std::size_t>(functions), area);
    self_.assign(gram_.size(), 0.0);
  }
  const solvers::Layout& layout() const override { return layout_; }
  bool symmetric() const override { return true; }  // A_i F_ij = A_j F_ji, by rays as well
  void apply(solvers::ConstColumns, solvers::Columns, Run&) const override {
    throw core::PreconditionError("areas alone: there is no matrix to multiply by");
  }
  std::span<const double> gram() const override { return gram_; }
  std::span<const double> self() const override { return self_; }

 private:
  solvers::Layout layout_;
  std::vector<double> gram_, self_;
};

}  // namespace interflect::fem
