#include "fem/assembly.h"

#include <algorithm>
#include <mutex>

namespace interflect::fem {

PairCounts assemble(const FormFactorMethod& method, std::span<const scene::SurfacePatch> patches, ExchangeSink& sink,
                    Run& run) {
  const auto n = static_cast<Index>(patches.size());
  const Index block = std::clamp<Index>(n / 24, 64, 512), blocks = (n + block - 1) / block;
  std::vector<std::pair<Index, Index>> tasks;
  for (Index I = 0; I < blocks; ++I)
    for (Index J = I; J < blocks; ++J) tasks.emplace_back(I * block, J * block);
  core::Progress::Stage stage(run.progress, "form factors", static_cast<std::uint64_t>(n * (n - 1) / 2));
  PairCounts total;
  std::mutex total_mutex;
  run.threads.for_blocks(static_cast<Index>(tasks.size()), 1, [&](Index task, Index) {
    run.throw_if_stopped("form factors");
    const auto [row, column] = tasks[static_cast<std::size_t>(task)];
    const Index rows = std::min(block, n - row), columns = std::min(block, n - column);
    const PairCounts counts = method.exchange({patches, row, rows}, {patches, column, columns}, sink, run);
    stage.advance(static_cast<std::uint64_t>(row == column ? rows * (rows - 1) / 2 : rows * columns));
    const std::scoped_lock lock(total_mutex);
    total += counts;
  });
  return total;
}

std::unique_ptr<DenseSymmetric> aggregated(const DenseSymmetric& fine, Run& run) {
  const Index parents = fine.size() / 4;
  std::vector<double> areas(static_cast<std::size_t>(parents));
  for (std::size_t I = 0; I < areas.size(); ++I)
    for (std::size_t k = 0; k < 4; ++k) areas[I] += fine.gram()[4 * I + k];
  auto coarse = std::make_unique<DenseSymmetric>(std::move(areas));
  run.threads.for_blocks(parents, 16, [&](Index begin, Index end) {
    for (Index I = begin; I < end; ++I)
      for (Index J = I; J < parents; ++J) {
        double sum = 0.0;
        for (Index i = 4 * I; i < 4 * I + 4; ++i)
          for (Index j = 4 * J; j < 4 * J + 4; ++j) sum += fine.entry(i, j);
        if (sum > 0.0) coarse->add(I, J, {sum});
      }
  });
  return coarse;
}

}  // namespace interflect::fem
