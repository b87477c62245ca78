#include "fem/collocation.h"

#include <Eigen/LU>
#include <cmath>

#include "core/error.h"

namespace interflect::fem {

namespace {

/// As many as there are functions.
Rule nodes_of(CollocationNodes nodes, int order) {
  if (nodes == CollocationNodes::gauss_points) return gauss_legendre(order + 1);
  const double inner = 0.5 - 0.5 / std::sqrt(5.0);
  switch (order) {
    case 1:
      return {{0, 0, 0}, {1, 0, 0}};
    case 2:
      return {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}};
    case 3:
      return {{0, 0, 0}, {inner, 0, 0}, {1 - inner, 0, 0}, {1, 0, 0}};
    default:
      throw core::PreconditionError("Collocation: an order of 1 or more expected at vertices");
  }
}

}  // namespace

Collocation::Collocation(const Space& space, CollocationNodes where, const Kernel& kernel, int points, Run& run)
    : space_(space),
      T_(solvers::ColumnMatrix::Zero(space.layout().unknowns(), space.layout().unknowns())),
      ones_(static_cast<std::size_t>(space.layout().unknowns()), 1.0),
      self_(ones_.size(), 0.0) {
  const Index count = std::ssize(space.panels());
  for (Index i = 0; i < count; ++i) {
    if (space.panel(i).corners != 2) throw core::PreconditionError("Collocation: segments expected");
    const PanelNodes at = space.nodes(i, nodes_of(where, space.order()));
    nodes_.insert(nodes_.end(), at.position.begin(), at.position.end());
    to_coefficients_.push_back(at.values.inverse());
  }
  run.threads.for_blocks(count, 1, [&](Index i, Index) {
    run.throw_if_stopped("collocation matrix");
    for (Index j = 0; j < count; ++j) {
      if (j == i) continue;
      const PanelNodes at = space.nodes(j, points);
      for (Index a = space.first(i); a < space.first(i) + space.functions(i); ++a) {
        Eigen::RowVectorXd of_functions = Eigen::RowVectorXd::Zero(space.functions(j));
        for (std::size_t k = 0; k < at.weight.size(); ++k)
          of_functions += at.weight[k] * kernel(node(a), space.panel(i).normal, at.position[k], space.panel(j).normal) *
                          at.values.row(static_cast<Index>(k));
        T_.row(a).segment(space.first(j), space.functions(j)) =
            of_functions * to_coefficients_[static_cast<std::size_t>(j)];
      }
    }
  });
}

void Collocation::apply(solvers::ConstColumns b, solvers::Columns out, Run&) const { out.noalias() = T_ * b; }

void Collocation::rows(Index first, Index count, solvers::Columns out) const {
  out = T_.middleRows(first, count);
  evaluated_.fetch_add(count, std::memory_order_relaxed);
}

Eigen::VectorXd Collocation::coefficients(const Eigen::VectorXd& at_nodes) const {
  Eigen::VectorXd c(at_nodes.size());
  for (Index i = 0; i < std::ssize(space_.panels()); ++i)
    c.segment(space_.first(i), space_.functions(i)) =
        to_coefficients_[static_cast<std::size_t>(i)] * at_nodes.segment(space_.first(i), space_.functions(i));
  return c;
}

}  // namespace interflect::fem
