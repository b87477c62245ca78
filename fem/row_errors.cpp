#include "fem/row_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "core/estimate.h"
#include "fem/assembly.h"

namespace interflect::fem {

namespace {

constexpr double unit = 0x1p-52;
constexpr int most_passes = 6;

std::vector<double> areas_of(std::span<const scene::SurfacePatch> patches) {
  std::vector<double> areas;
  for (const scene::SurfacePatch& patch : patches) areas.push_back(patch.area);
  return areas;
}

std::vector<Index> rows_above(double tolerance, const RowErrors& errors, Index n) {
  std::vector<Index> rows;
  for (Index a = 0; a < n; ++a)
    if (errors.of(a) > tolerance) rows.push_back(a);
  return rows;
}

/// Every pair of which at least one is among `rows`, ascending: a pair of two of them once.
PairCounts assemble_rows_again(const FormFactorMethod& method, std::span<const Index> rows, std::span<const scene::SurfacePatch> patches,
                               ExchangeSink& sink, Run& run) {
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

}  // namespace

RowErrors::RowErrors(ExchangeSink& sink, std::span<const double> areas)
    : sink_(sink), areas_(areas), sum_(areas.size()), counts_(areas.size(), 1) {}

void RowErrors::add(Index a, Index b, const ExchangeEntry& entry) {
  sink_.add(a, b, entry);
  const double error = entry.bound + normal_95 * entry.standard_error;
  count(a, error);
  if (a != b) count(b, error);
}

void RowErrors::count(Index a, double error) {
  const auto at = static_cast<std::size_t>(a);
  if (!counts_[at] || error == 0) return;
  const double units = std::ceil(error / areas_[at] / unit);
  constexpr double most = 0x1p60;  // 256: no sum of form factors is wrong by as much
  sum_[at].fetch_add(static_cast<std::uint64_t>(units < most ? units : most), std::memory_order_relaxed);
}

double RowErrors::of(Index a) const { return unit * static_cast<double>(sum_[static_cast<std::size_t>(a)].load(std::memory_order_relaxed)); }

std::vector<double> RowErrors::all() const {
  std::vector<double> errors;
  for (Index a = 0; a < static_cast<Index>(sum_.size()); ++a) errors.push_back(of(a));
  return errors;
}

void RowErrors::count_afresh(std::span<const Index> rows) {
  std::fill(counts_.begin(), counts_.end(), std::uint8_t{0});
  for (const Index a : rows) {
    counts_[static_cast<std::size_t>(a)] = 1;
    sum_[static_cast<std::size_t>(a)].store(0, std::memory_order_relaxed);
  }
}

double entry_tolerance(double of_rows) { return std::min(0.1, 4 * of_rows); }

ToleranceReport assemble_to_tolerance(const std::function<std::unique_ptr<FormFactorMethod>(double)>& make, double tolerance,
                                      std::span<const scene::SurfacePatch> patches, ExchangeSink& sink, Run& run) {
  const std::vector<double> areas = areas_of(patches);
  const auto n = static_cast<Index>(patches.size());
  RowErrors errors(sink, areas);
  ToleranceReport report;
  double relative = entry_tolerance(tolerance);
  std::unique_ptr<FormFactorMethod> method = make(relative);
  report.pairs = assemble(*method, patches, errors, run);
  report.passes = 1;
  std::vector<Index> rows = rows_above(tolerance, errors, n);
  while (!rows.empty() && report.passes < most_passes && method->granularity() == FormFactorMethod::Granularity::pair) {
    method = make(relative *= 0.25);
    errors.count_afresh(rows);
    report.pairs += assemble_rows_again(*method, rows, patches, errors, run);
    ++report.passes;
    rows = rows_above(tolerance, errors, n);
  }
  report.row_errors = errors.all();
  report.met = rows.empty();
  return report;
}

}  // namespace interflect::fem
