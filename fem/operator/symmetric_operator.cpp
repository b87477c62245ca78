#include "fem/operator/symmetric_operator.h"

namespace interflect::fem {

std::vector<double> SymmetricOperator::row_sums(Run& run) const {
  const solvers::ColumnMatrix ones = solvers::ColumnMatrix::Ones(size(), 1);
  solvers::ColumnMatrix sums(size(), 1);
  apply(ones, sums, run);
  std::vector<double> F(static_cast<std::size_t>(size()));
  for (std::size_t a = 0; a < F.size(); ++a) F[a] = sums(static_cast<Index>(a), 0) / gram()[a];
  return F;
}

}  // namespace interflect::fem
