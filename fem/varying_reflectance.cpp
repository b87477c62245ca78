#include "fem/varying_reflectance.h"

namespace interflect::fem {

solvers::Reflection varying_reflectance(const Space& space, const ReflectanceField& rho, int channels, int points) {
  std::vector<solvers::Reflection::Block> blocks;
  for (Index i = 0; i < std::ssize(space.panels()); ++i) {
    const PanelNodes at = space.nodes(i, points);
    const Index functions = space.functions(i);
    solvers::Reflection::Block block{space.first(i), {}};
    block.of_channel.assign(static_cast<std::size_t>(channels), Eigen::MatrixXd::Zero(functions, functions));
    for (std::size_t q = 0; q < at.weight.size(); ++q) {
      const Eigen::RowVectorXd N = at.values.row(static_cast<Index>(q));
      const Spectrum here = rho(i, at.position[q]);
      for (int c = 0; c < channels; ++c)
        block.of_channel[static_cast<std::size_t>(c)] +=
            at.weight[q] / space.panel(i).measure * here[c] * N.transpose() * N;
    }
    blocks.push_back(std::move(block));
  }
  return {solvers::ColumnMatrix::Zero(space.layout().unknowns(), channels), std::move(blocks)};
}

}  // namespace interflect::fem
