#include "fem/collocation.h"

#include <functional>

namespace interflect::fem {
namespace {

using RowOfFunctions = std::function<void(Index node, Eigen::Ref<Eigen::RowVectorXd> out)>;

/// T = F P, with rows of F from `row`.
NodeOperator operator_of(const NodeSet& nodes, const RowOfFunctions& row, Run& run) {
  constexpr Index rows_a_task = 16;
  solvers::ColumnMatrix T(nodes.size(), nodes.size());
  core::Progress::Stage stage(run.progress, "collocation", nodes.position.size());
  run.threads.for_blocks(nodes.size(), rows_a_task, [&](Index first, Index end) {
    Eigen::RowVectorXd F(nodes.P.rows());
    for (Index a = first; a < end; ++a) {
      run.throw_if_stopped("collocation");
      row(a, F);
      T.row(a) = F * nodes.P;
      stage.advance(1);
    }
  });
  return NodeOperator(std::move(T));
}

}  // namespace

NodeOperator collocation(const Space& space, const NodeSet& nodes, const Kernel& kernel, int points, Run& run) {
  std::vector<PanelNodes> sources;
  for (Index j = 0; j < std::ssize(space.panels()); ++j) sources.push_back(space.nodes(j, points));
  const auto row = [&](Index a, Eigen::Ref<Eigen::RowVectorXd> out) {
    const Vec3& x = nodes.position[static_cast<std::size_t>(a)];
    const Index own = nodes.panel[static_cast<std::size_t>(a)];
    out.setZero();
    for (Index j = 0; j < std::ssize(space.panels()); ++j) {
      if (j == own) continue;
      const PanelNodes& at = sources[static_cast<std::size_t>(j)];
      for (std::size_t k = 0; k < at.weight.size(); ++k)
        out.segment(space.first(j), space.functions(j)) +=
            at.weight[k] * kernel(x, space.panel(own).normal, at.position[k], space.panel(j).normal) *
            at.values.row(static_cast<Index>(k));
    }
  };
  return operator_of(nodes, row, run);
}

NodeOperator collocation(const NodeSet& nodes, const PointViewFactors& factors,
                         std::span<const scene::SurfacePatch> patches, Run& run) {
  const auto row = [&](Index a, Eigen::Ref<Eigen::RowVectorXd> out) {
    const auto node = static_cast<std::size_t>(a);
    const scene::SurfacePatch& patch = patches[static_cast<std::size_t>(nodes.panel[node])];
    std::vector<double> rounding(patches.size());
    factors({nodes.position[node], patch.normal(), patch.surface}, {out.data(), static_cast<std::size_t>(out.size())},
            rounding);
  };
  return operator_of(nodes, row, run);
}

}  // namespace interflect::fem
