#pragma once

#include "fem/bounds/node_residuals.h"

namespace interflect::fem {

/// T e over the leaves of a CellTransport, of e = r + rho T e with bounds of both on nodes.
///
/// Of what a place sees whole, int k r = F m + (<= across d) with the mean m of r and its mean deviation d from that;
/// of other parts F is known, and r is between its own bounds there.  What is near gets what is left of sum F <= 1,
/// the dearest first (allotment.h).
class ErrorTransport {
 public:
  /// @param Te  on nodes, a row as NodeResiduals have; both outlive this
  ErrorTransport(const NodeResiduals& r, const ManyBounds& Te) : r_(r), Te_(Te) {}

  std::vector<Bounds> over_leaves(const CellTransport& transport) const;

 private:
  using Row = Eigen::RowVectorXd;

  Index channels() const { return r_.reflectance().cols(); }
  double highest(const ManyBounds& r, std::uint32_t source, Index channel, int sign) const;
  void add(const Exchange& from, int sign, ShiftedSum& sum) const;
  std::vector<ShiftedSum> far_sums(const CellTransport& transport, int sign) const;
  Row middle_of(std::span<const Leaf> leaves, int sign) const;
  Row highest(const CellTransport& transport, const Leaf& leaf, int sign, ShiftedSum sum) const;

  const NodeResiduals& r_;
  const ManyBounds& Te_;
};

}  // namespace interflect::fem
