#include <algorithm>

#include "fem/closure_law.h"

namespace interflect::fem {
namespace {

/// An entry between its bounds follows with the slope w_ab / kappa; one at a bound stays there.
class LeastSquares final : public ClosureLaw {
 public:
  LeastSquares(const SymmetricOperator& K, const EnvironmentColumn* environment, EntryVariances variances, Run& run)
      : ClosureLaw(K, environment, variances, run), variances_(std::move(variances)) {}

  double repaired(const StoredPair& pair) const override { return std::clamp(unbounded(pair), 0.0, most(pair)); }
  Vector times(const Vector& v) const override {
    return matrix().sums_by_row(run(), 1, [&](const StoredPair& p, Vector& sums) {
      const double slope = slope_of(p);
      sums(p.a, 0) += slope * v(p.b, 0);
      if (p.a != p.b) sums(p.b, 0) += slope * v(p.a, 0);
    });
  }

 private:
  void sum_entries(Vector& sums, Vector& stiffness) override {
    const solvers::ColumnMatrix both =
        matrix().sums_by_row(run(), 2, [&](const StoredPair& p, solvers::ColumnMatrix& to) {
          const double K = repaired(p), slope = slope_of(p);
          to(p.a, 0) += K;
          to(p.a, 1) += slope;
          if (p.a == p.b) return;
          to(p.b, 0) += K;
          to(p.b, 1) += slope;
        });
    sums = both.col(0);
    stiffness = both.col(1);
  }
  double most(const StoredPair& p) const {
    return p.K == 0 ? 0.0 : std::min(matrix().gram()[p.a], matrix().gram()[p.b]);
  }
  double weight(const StoredPair& p) const { return variances_(p) / variances_.kappa; }
  double unbounded(const StoredPair& p) const { return p.K + weight(p) * (u()(p.a, 0) + u()(p.b, 0)); }
  double slope_of(const StoredPair& p) const {
    const double K = unbounded(p);
    return K > 0 && K < most(p) ? weight(p) : 0.0;
  }

  EntryVariances variances_;
};

}  // namespace

std::unique_ptr<ClosureLaw> least_squares_law(const SymmetricOperator& K, const EnvironmentColumn* environment,
                                              const EntryVariances& variances, Run& run) {
  return std::make_unique<LeastSquares>(K, environment, variances, run);
}

}  // namespace interflect::fem
