#include "fem/galerkin.h"

namespace interflect::fem {

Eigen::MatrixXd galerkin_block(const Space& space, Index i, Index j, const Kernel& kernel, const PairRule& rule) {
  const Panel &a = space.panel(i), &b = space.panel(j);
  Eigen::VectorXd N(space.functions(i)), M(space.functions(j));
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(N.size(), M.size());
  rule.for_nodes(a, b, [&](const PairNode& node) {
    const Vec3 x = point_on(a.ring(), node.u_a, node.v_a), y = point_on(b.ring(), node.u_b, node.v_b);
    const double k = node.weight * jacobian(a.ring(), node.u_a, node.v_a) * jacobian(b.ring(), node.u_b, node.v_b) *
                     kernel(x, a.normal, y, b.normal);
    if (k == 0) return;
    space.basis(i).at(node.u_a, node.v_a, {N.data(), static_cast<std::size_t>(N.size())});
    space.basis(j).at(node.u_b, node.v_b, {M.data(), static_cast<std::size_t>(M.size())});
    block += k * N * M.transpose();
  });
  return block;
}

void galerkin(const Space& space, const Kernel& kernel, const PairRule& rule, ExchangeSink& sink, Run& run) {
  const Index count = std::ssize(space.panels());
  run.threads.for_blocks(count, 1, [&](Index i, Index) {
    run.throw_if_stopped("Galerkin matrix");
    for (Index j = i + 1; j < count; ++j) {
      const Eigen::MatrixXd block = galerkin_block(space, i, j, kernel, rule);
      for (Index a = 0; a < block.rows(); ++a)
        for (Index b = 0; b < block.cols(); ++b)
          if (block(a, b) != 0) sink.add(space.first(i) + a, space.first(j) + b, {block(a, b)});
    }
  });
}

}  // namespace interflect::fem
