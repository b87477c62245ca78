#pragma once

#include <span>
#include <vector>

#include "fem/bounds/cell_transport.h"

namespace interflect::fem {

/// r = E + rho T B_h - B_h on the nodes of elements' quarter trees (cell_view.h), from T B_h over the leaves of a
/// CellTransport; 0 on black elements, which come after the solution's.
class NodeResiduals {
 public:
  /// @param b  outlives this
  NodeResiduals(const LinearField& b, const RadiositySolution& solution);

  /// Of all of an element's nodes; of different elements from any threads.
  void find(Index element, const CellTransport& transport);

  /// What a node holds, or is held by.
  struct Cover {
    int node;
    std::size_t leaf;
  };
  std::span<const Cover> covers(Index element) const { return covers_[static_cast<std::size_t>(element)]; }

  /// Anywhere in a part of an element about whose centre T B_h is a polynomial.
  Bounds over(Index element, const Cell& part, SmoothSum TB) const;

  const solvers::ColumnMatrix& exitance() const { return exitance_; }        ///< an element a row, black ones too
  const solvers::ColumnMatrix& reflectance() const { return reflectance_; }  ///< likewise
  const ManyBounds& everywhere() const { return everywhere_; }  ///< element * QuarterTree::nodes + node a row
  const ManyBounds& mean() const { return mean_; }
  const solvers::ColumnMatrix& deviation() const { return deviation_; }  ///< mean |r - its mean|, at most
  double rounding() const { return 1e-11 * b_.largest(); }               ///< of B_h and T B_h

 private:
  void find(Index element, int node, const Cell& cell, const CellTransport& transport);
  Bounds mean_over(Index element, const Cell& part, const Bounds& mean_TB) const;

  const LinearField& b_;
  solvers::ColumnMatrix exitance_, reflectance_;
  ManyBounds everywhere_, mean_;
  solvers::ColumnMatrix deviation_;
  std::vector<std::vector<Cover>> covers_;
};

}  // namespace interflect::fem
