#include "fem/operator/node_operator.h"

#include "core/error.h"

namespace interflect::fem {

NodeOperator::NodeOperator(solvers::ColumnMatrix T)
    : T_(std::move(T)),
      layout_(solvers::Layout::uniform(T_.rows(), 1)),
      ones_(static_cast<std::size_t>(T_.rows()), 1.0) {
  if (T_.rows() != T_.cols()) throw core::PreconditionError("NodeOperator: a square matrix expected");
  for (Index a = 0; a < T_.rows(); ++a) self_.push_back(T_(a, a));
}

void NodeOperator::apply(solvers::ConstColumns b, solvers::Columns out, Run& run) const {
  constexpr Index rows_a_task = 64;
  run.threads.for_blocks(T_.rows(), rows_a_task, [&](Index first, Index end) {
    out.middleRows(first, end - first).noalias() = T_.middleRows(first, end - first) * b;
  });
}

void NodeOperator::rows(Index first, Index count, solvers::Columns out) const {
  out = T_.middleRows(first, count);
  evaluated_.fetch_add(count, std::memory_order_relaxed);
}

}  // namespace interflect::fem
