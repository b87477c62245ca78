#include "fem/closure_law.h"

#include <algorithm>
#include <cmath>

#include "core/ordered_sum.h"

namespace interflect::fem {
namespace {

constexpr double least_relative_error = 1e-6;  // so that no entry is taken for exact, and every row can be moved

}  // namespace

EntryVariances entry_variances(const SymmetricOperator& K, std::span<const double> row_bound,
                               std::span<const double> seen, std::span<const double> row_sum, const Run& run) {
  EntryVariances variances;
  for (std::size_t a = 0; a < row_sum.size(); ++a) {
    const double off = std::max(row_bound.empty() ? 0.0 : row_bound[a], seen[a]);
    variances.relative.push_back(row_sum[a] > 0 ? std::max(off / row_sum[a], least_relative_error) : 1.0);
  }
  const solvers::ColumnMatrix sums = K.sums_by_row(run, 2, [&](const StoredPair& p, solvers::ColumnMatrix& to) {
    to(p.a, 0) += variances(p);  // any row will do: their sum is asked for
    to(p.a, 1) += p.K;
  });
  const double w = core::ordered_sum(sums.col(0)), all = core::ordered_sum(sums.col(1));
  if (w > 0 && all > 0) variances.kappa = w / all;
  return variances;
}

ClosureLaw::ClosureLaw(const SymmetricOperator& K, const EnvironmentColumn* environment,
                       const EntryVariances& variances, Run& run)
    : K_(K), run_(run), found_(Vector::Zero(K.size(), 1)), slope_(found_), aside_(found_) {
  if (environment == nullptr) return;
  for (Index a = 0; a < K.size(); ++a) {
    const auto row = static_cast<std::size_t>(a);
    const double area = K.gram()[row], deviation = area * environment->standard_error[row];
    found_(a, 0) = area * environment->factor[row];
    slope_(a, 0) = deviation * deviation / variances.kappa;
  }
}

void ClosureLaw::set(const Vector& u) {
  u_ = u;
  sum_entries(sums_, stiffness_);
  environment_ = found_;
  for (Index a = 0; a < size(); ++a) {
    if (slope_(a, 0) == 0) continue;
    const double z = found_(a, 0) + slope_(a, 0) * u(a, 0);
    environment_(a, 0) = std::clamp(z, 0.0, areas()(a));
    if (z == environment_(a, 0)) stiffness_(a, 0) += slope_(a, 0);
  }
  sums_ += environment_ + aside_;
}

double ClosureLaw::row_error() const {
  return size() == 0 ? 0.0 : (missing().array() / areas().array()).abs().maxCoeff();
}

}  // namespace interflect::fem
