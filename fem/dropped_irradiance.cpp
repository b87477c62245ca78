#include "fem/dropped_irradiance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace interflect::fem {
namespace {

constexpr Index rows_at_once = 32;

std::vector<Index> brightest_first(const solvers::ColumnMatrix& B, Index channel) {
  std::vector<Index> order(static_cast<std::size_t>(B.rows()));
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index i, Index j) {
    const double of_i = std::abs(B(i, channel)), of_j = std::abs(B(j, channel));
    return of_i != of_j ? of_i > of_j : i < j;
  });
  return order;
}

double most_from(const SymmetricOperator& K, Index i, const solvers::ColumnMatrix& B, Index channel,
                 const std::vector<Index>& order) {
  const double area = K.gram()[static_cast<std::size_t>(i)];
  double left = K.dropped()[static_cast<std::size_t>(i)], sum = 0;
  for (const Index j : order) {
    if (!(left > 0) || B(j, channel) == 0) break;
    if (j == i || K.entry(i, j) != 0) continue;
    const double x = std::min(left, K.drop_below() * std::min(1.0, K.gram()[static_cast<std::size_t>(j)] / area));
    sum += x * std::abs(B(j, channel));
    left -= x;
  }
  return sum;
}

}  // namespace

solvers::ColumnMatrix dropped_irradiance(const SymmetricOperator& K, const solvers::ColumnMatrix& B, const Run& run) {
  solvers::ColumnMatrix most = solvers::ColumnMatrix::Zero(B.rows(), B.cols());
  if (K.dropped().empty()) return most;
  for (Index channel = 0; channel < B.cols(); ++channel) {
    const std::vector<Index> order = brightest_first(B, channel);
    run.threads.for_blocks(B.rows(), rows_at_once, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) most(i, channel) = most_from(K, i, B, channel, order);
    });
  }
  return most;
}

}  // namespace interflect::fem
