#pragma once

#include <mutex>
#include <span>
#include <vector>

#include "fem/form_factor/method.h"
#include "solvers/transport_operator.h"

namespace interflect::fem {

/// K of constants of which nothing is stored: what an element sends to all others is computed when it is asked for, by
/// any form-factor method that can be asked for a part of the matrix.
///
/// Methods that go from pair to pair have K_ab = K_ba, the numbers that a stored matrix has.  Of those that see a row
/// at once, column i is the view from i, K_ai := A_i F_ia: there are no rows then, and K is as symmetric as two views
/// of one pair agree; a stored matrix joins both.
///
/// Memory: a few numbers an element.  A product costs a column for each element that is not dark.
/// Test: tests/fem/rows_on_demand.cpp
class RowsOnDemand final : public solvers::TransportOperator, public solvers::RowAccess {
 public:
  /// All outlive this.  @throws core::InputError  the method computes all or nothing
  RowsOnDemand(std::span<const scene::SurfacePatch> patches, const FormFactorMethod& method, const Run& run);

  const solvers::Layout& layout() const override { return layout_; }
  bool symmetric() const override { return method_.granularity() == FormFactorMethod::Granularity::pair; }
  void apply(solvers::ConstColumns b, solvers::Columns out, Run& run) const override;
  std::span<const double> gram() const override { return areas_; }
  std::span<const double> self() const override { return self_; }
  const solvers::RowAccess* rows() const override { return symmetric() ? this : nullptr; }
  const solvers::RowAccess* columns() const override { return this; }
  /// Threads take turns: each row is computed by all of them.
  void rows(Index first, Index count, solvers::Columns out) const override;
  Index evaluated() const override;

  /// A column, and what is known of its errors; one number an element [m²].
  struct Column {
    Index of = -1;
    std::vector<double> K, standard_error, bound;
  };
  /// The one that was computed last, until the next is: for who asks in one thread.
  const Column& last() const { return last_; }
  PairCounts counts() const { return counts_; }

 private:
  class Sink;
  void compute(Index i) const;
  PairCounts pairs_of(Index i, Index begin, Index end, ExchangeSink& sink) const;

  std::span<const scene::SurfacePatch> patches_;
  const FormFactorMethod& method_;
  const Run& run_;
  solvers::Layout layout_;
  std::vector<double> areas_, self_;
  mutable std::mutex mutex_;
  mutable Index evaluated_ = 0;
  mutable Column last_;
  mutable PairCounts counts_;
};

}  // namespace interflect::fem
