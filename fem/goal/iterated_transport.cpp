#include "fem/goal/iterated_transport.h"

namespace interflect::fem {

ElementNodes element_nodes(std::span<const scene::SurfacePatch> patches, int points) {
  const RulePair rules = rules_of(points);
  ElementNodes out;
  out.first.push_back(0);
  for (const scene::SurfacePatch& patch : patches) {
    append_nodes(patch.ring(), rules.of(patch.corners), out.nodes);
    out.first.push_back(out.nodes.size());
  }
  return out;
}

solvers::ColumnMatrix iterated_transport(const PointViewFactors& factors, std::span<const scene::SurfacePatch> patches,
                                         const ElementNodes& nodes, solvers::ConstColumns b, Run& run) {
  solvers::ColumnMatrix out(static_cast<Index>(nodes.size()), b.cols());
  core::Progress::Stage stage(run.progress, "residual", patches.size());
  run.threads.for_blocks(static_cast<Index>(patches.size()), 1, [&](Index element, Index) {
    run.throw_if_stopped("residual");
    const auto i = static_cast<std::size_t>(element);
    const scene::SurfacePatch& patch = patches[i];
    const Vec3 normal = patch.normal();
    Eigen::RowVectorXd F(b.rows());
    std::vector<double> rounding(patches.size());
    for (std::size_t q = nodes.first[i]; q < nodes.first[i + 1]; ++q) {
      factors({nodes.nodes[q].position, normal, patch.surface}, {F.data(), static_cast<std::size_t>(F.size())},
              rounding);
      out.row(static_cast<Index>(q)).noalias() = F * b;
    }
    stage.advance(1);
  });
  return out;
}

}  // namespace interflect::fem
