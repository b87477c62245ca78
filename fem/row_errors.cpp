#include "fem/row_errors.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "core/estimate.h"
#include "fem/assembly.h"

namespace interflect::fem {

namespace {

std::vector<double> areas_of(std::span<const scene::SurfacePatch> patches) {
  std::vector<double> areas;
  for (const scene::SurfacePatch& patch : patches) areas.push_back(patch.area);
  return areas;
}

std::vector<Index> rows_above(double tolerance, std::span<const double> errors) {
  std::vector<Index> rows;
  for (std::size_t a = 0; a < errors.size(); ++a)
    if (errors[a] > tolerance) rows.push_back(static_cast<Index>(a));
  return rows;
}

/// Every pair of which at least one is among `rows`, ascending: a pair of two of them once.
PairCounts assemble_rows_again(const FormFactorMethod& method, std::span<const Index> rows,
                               std::span<const scene::SurfacePatch> patches, ExchangeSink& sink, Run& run) {
  const auto n = static_cast<Index>(patches.size());
  core::Progress::Stage stage(run.progress, "form factors, again", static_cast<std::uint64_t>(rows.size()));
  PairCounts total;
  std::mutex mutex;
  run.threads.for_blocks(static_cast<Index>(rows.size()), 1, [&](Index k, Index) {
    run.throw_if_stopped("form factors");
    const Index a = rows[static_cast<std::size_t>(k)];
    PairCounts counts = method.exchange({patches, a, 1}, {patches, a + 1, n - a - 1}, sink, run);
    Index from = 0;  // pairs below, but for those that other rows bring
    for (const Index other : rows.first(static_cast<std::size_t>(k) + 1)) {
      if (other > from) counts += method.exchange({patches, from, other - from}, {patches, a, 1}, sink, run);
      from = other + 1;
    }
    stage.advance(1);
    const std::scoped_lock lock(mutex);
    total += counts;
  });
  return total;
}

class SinkAssembly final : public RowAssembly {
 public:
  SinkAssembly(std::span<const scene::SurfacePatch> patches, ExchangeSink& sink, Run& run)
      : patches_(patches), run_(run), areas_(areas_of(patches)), errors_(sink, areas_) {}

  void everything(const FormFactorMethod& method) override { counts_ += assemble(method, patches_, errors_, run_); }
  void again(const FormFactorMethod& method, std::span<const Index> rows) override {
    errors_.count_afresh(rows);
    counts_ += assemble_rows_again(method, rows, patches_, errors_, run_);
  }
  std::vector<double> row_errors() const override { return errors_.all(); }
  PairCounts counts() const override { return counts_; }

 private:
  std::span<const scene::SurfacePatch> patches_;
  Run& run_;
  std::vector<double> areas_;
  RowErrors errors_;
  PairCounts counts_;
};

}  // namespace

RowErrors::RowErrors(ExchangeSink& sink, std::span<const double> areas)
    : sink_(sink), tally_(areas), counts_(areas.size(), 1) {}

void RowErrors::add(Index a, Index b, const ExchangeEntry& entry) {
  sink_.add(a, b, entry);
  const double error = entry.bound + normal_95 * entry.standard_error;
  const auto counts = [&](Index row) { return counts_[static_cast<std::size_t>(row)] != 0; };
  if (counts(a)) tally_.add(a, error);
  if (a != b && counts(b)) tally_.add(b, error);
}

void RowErrors::count_afresh(std::span<const Index> rows) {
  std::fill(counts_.begin(), counts_.end(), std::uint8_t{0});
  for (const Index a : rows) {
    counts_[static_cast<std::size_t>(a)] = 1;
    tally_.clear(a);
  }
}

void BeyondTolerance::add(Index a, Index b, const ExchangeEntry& entry) {
  sink_.add(a, b, entry);
  const double beyond = entry.bound - tolerance_ * entry.K;
  if (beyond <= 0) return;  // what is no number counts
  tally_.add(a, beyond);
  if (a != b) tally_.add(b, beyond);
}

double entry_tolerance(double of_rows, int pass) { return std::ldexp(std::min(0.1, 4 * of_rows), -2 * pass); }

double negligible_error(double tolerance, double area, Index elements) {
  return 0.25 * tolerance * area / static_cast<double>(elements);
}

ToleranceReport until_rows_meet(double tolerance, const MethodMaker& make, RowAssembly& assembly) {
  ToleranceReport report;
  std::unique_ptr<FormFactorMethod> method = make(entry_tolerance(tolerance));
  assembly.everything(*method);
  report.row_errors = assembly.row_errors();
  report.passes = 1;
  std::vector<Index> rows = rows_above(tolerance, report.row_errors);
  while (!rows.empty() && report.passes < most_passes && method->granularity() == FormFactorMethod::Granularity::pair) {
    method = make(entry_tolerance(tolerance, report.passes));
    assembly.again(*method, rows);
    report.row_errors = assembly.row_errors();
    ++report.passes;
    rows = rows_above(tolerance, report.row_errors);
  }
  report.pairs = assembly.counts();
  report.met = rows.empty();
  return report;
}

ToleranceReport assemble_to_tolerance(const MethodMaker& make, double tolerance,
                                      std::span<const scene::SurfacePatch> patches, ExchangeSink& sink, Run& run) {
  SinkAssembly assembly(patches, sink, run);
  return until_rows_meet(tolerance, make, assembly);
}

}  // namespace interflect::fem
