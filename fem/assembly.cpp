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

/// Blocks of rows and columns that have every pair a < b with b >= first_new once; blocks of the diagonal have others
/// too, which `exchange` leaves out.
struct Blocks {
  std::vector<std::pair<ElementBlock, ElementBlock>> all;
  std::uint64_t pairs = 0;

  Blocks(std::span<const scene::SurfacePatch> patches, Index first_new) {
    const auto n = static_cast<Index>(patches.size());
    const Index block = std::clamp<Index>(n / 24, 64, 512);
    for (Index column = first_new; column < n; column += block)
      for (Index row = 0; row < std::min(column + block, n);) {
        const Index rows = std::min(block, (row < first_new ? first_new : n) - row);  // rows end where columns begin
        all.emplace_back(ElementBlock{patches, row, rows}, ElementBlock{patches, column, std::min(block, n - column)});
        pairs += pairs_of(all.back());
        row += rows;
      }
  }
  static std::uint64_t pairs_of(const std::pair<ElementBlock, ElementBlock>& task) {
    const auto [rows, columns] = task;
    return static_cast<std::uint64_t>(rows.first == columns.first ? rows.count * (rows.count - 1) / 2
                                                                  : rows.count * columns.count);
  }
};

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
      for (Index b = a; b < n; ++b) {
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

PairCounts assemble_new(const FormFactorMethod& method, std::span<const scene::SurfacePatch> patches, Index first_new,
                        ExchangeSink& sink, Run& run) {
  const Blocks tasks(patches, first_new);
  core::Progress::Stage stage(run.progress, "form factors", tasks.pairs);
  Total total;
  run.threads.for_blocks(static_cast<Index>(tasks.all.size()), 1, [&](Index k, Index) {
    run.throw_if_stopped("form factors");
    const auto& task = tasks.all[static_cast<std::size_t>(k)];
    total.add(method.exchange(task.first, task.second, sink, run));
    stage.advance(Blocks::pairs_of(task));
  });
  return total.counts();
}

PairCounts assemble(const FormFactorMethod& method, std::span<const scene::SurfacePatch> patches, ExchangeSink& sink,
                    Run& run) {
  switch (method.granularity()) {
    case Granularity::pair:
      return assemble_new(method, patches, 0, sink, run);
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
