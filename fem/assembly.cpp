#include "fem/assembly.h"

#include <algorithm>
#include <mutex>

#include "fem/two_views.h"

namespace interflect::fem {
namespace {

using Granularity = FormFactorMethod::Granularity;

/// Sums counts that threads bring.
class Total {
 public:
  void add(const PairCounts& counts) {
    const std::scoped_lock lock(mutex_);
    counts_ += counts;
  }
  const PairCounts& counts() const { return counts_; }

 private:
  std::mutex mutex_;
  PairCounts counts_;
};

PairCounts assemble_pairs(const FormFactorMethod& method, std::span<const scene::SurfacePatch> patches,
                          ExchangeSink& sink, Run& run) {
  const auto n = static_cast<Index>(patches.size());
  const Index block = std::clamp<Index>(n / 24, 64, 512), blocks = (n + block - 1) / block;
  std::vector<std::pair<Index, Index>> tasks;
  for (Index I = 0; I < blocks; ++I)
    for (Index J = I; J < blocks; ++J) tasks.emplace_back(I * block, J * block);
  core::Progress::Stage stage(run.progress, "form factors", static_cast<std::uint64_t>(n * (n - 1) / 2));
  Total total;
  run.threads.for_blocks(static_cast<Index>(tasks.size()), 1, [&](Index task, Index) {
    run.throw_if_stopped("form factors");
    const auto [row, column] = tasks[static_cast<std::size_t>(task)];
    const Index rows = std::min(block, n - row), columns = std::min(block, n - column);
    total.add(method.exchange({patches, row, rows}, {patches, column, columns}, sink, run));
    stage.advance(static_cast<std::uint64_t>(row == column ? rows * (rows - 1) / 2 : rows * columns));
  });
  return total.counts();
}

PairCounts assemble_rows(const FormFactorMethod& method, std::span<const scene::SurfacePatch> patches,
                         ExchangeSink& sink, Run& run) {
  const auto n = static_cast<Index>(patches.size());
  constexpr Index rows_at_a_time = 4;
  TwoViews views(n);
  Total total;
  {
    core::Progress::Stage stage(run.progress, "form factors", static_cast<std::uint64_t>(n));
    run.threads.for_blocks(n, rows_at_a_time, [&](Index begin, Index end) {
      run.throw_if_stopped("form factors");
      total.add(method.exchange({patches, begin, end - begin}, {patches, 0, n}, views, run));
      stage.advance(static_cast<std::uint64_t>(end - begin));
    });
  }
  std::vector<std::uint64_t> clamped(static_cast<std::size_t>(n), 0);
  run.threads.for_blocks(n, 16, [&](Index begin, Index end) {
    for (Index a = begin; a < end; ++a)
      for (Index b = a + 1; b < n; ++b) {
        ExchangeEntry entry = views.joined(a, b);
        const double most =
            std::min(patches[static_cast<std::size_t>(a)].area, patches[static_cast<std::size_t>(b)].area);
        if (entry.K > most) entry.K = most, ++clamped[static_cast<std::size_t>(a)];
        if (entry.K > 0 || entry.standard_error > 0 || entry.bound > 0) sink.add(a, b, entry);
      }
  });
  PairCounts counts = total.counts();
  for (const std::uint64_t c : clamped) counts.clamped += c;
  return counts;
}

}  // namespace

PairCounts assemble(const FormFactorMethod& method, std::span<const scene::SurfacePatch> patches, ExchangeSink& sink,
                    Run& run) {
  switch (method.granularity()) {
    case Granularity::pair:
      return assemble_pairs(method, patches, sink, run);
    case Granularity::row:
      return assemble_rows(method, patches, sink, run);
    case Granularity::all:
      break;
  }
  const ElementBlock everything{patches, 0, static_cast<Index>(patches.size())};
  return method.exchange(everything, everything, sink, run);
}

std::unique_ptr<SymmetricOperator> aggregated(const SymmetricOperator& fine, Run& run) {
  const Index parents = fine.size() / 4;
  std::vector<double> areas(static_cast<std::size_t>(parents));
  for (std::size_t I = 0; I < areas.size(); ++I)
    for (std::size_t k = 0; k < 4; ++k) areas[I] += fine.gram()[4 * I + k];
  const auto fill = [&](ExchangeSink& coarse) {
    constexpr Index parents_at_a_time = 8;
    run.threads.for_blocks(parents, parents_at_a_time, [&](Index begin, Index end) {
      solvers::ColumnMatrix rows(4 * (end - begin), fine.size());
      fine.rows(4 * begin, 4 * (end - begin), rows);
      for (Index I = begin; I < end; ++I)
        for (Index J = I; J < parents; ++J) {
          double sum = 0.0;
          for (Index i = 4 * (I - begin); i < 4 * (I - begin) + 4; ++i)
            for (Index j = 4 * J; j < 4 * J + 4; ++j) sum += rows(i, j);
          if (sum > 0.0) coarse.add(I, J, {sum});
        }
    });
  };
  return fine.alike(std::move(areas), fill, run);
}

}  // namespace interflect::fem
