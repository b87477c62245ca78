#include "fem/operator/sparse_symmetric.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/format.h"
#include "fem/operator/panel_product.h"

namespace interflect::fem {
namespace {

constexpr std::size_t strip_count = 16, pairs_a_visit = 2048;
constexpr double factor_unit = 0x1p-52, variance_unit = 0x1p-62;

void add_units(std::atomic<std::uint64_t>& sum, double value, double unit) {
  const double units = std::ceil(value / unit);
  constexpr double most = 0x1p60;
  sum.fetch_add(static_cast<std::uint64_t>(units < most ? units : most), std::memory_order_relaxed);
}

}  // namespace

SparseSymmetric::SparseSymmetric(std::vector<double> areas, double drop_below)
    : layout_(solvers::Layout::uniform(static_cast<Index>(areas.size()), 1)),
      areas_(std::move(areas)),
      self_(areas_.size(), 0.0),
      drop_below_(drop_below),
      panels_((areas_.size() + panel_rows - 1) / panel_rows) {}

void SparseSymmetric::cut_into_strips() {
  std::size_t all = 0, passed = 0;
  for (const Panel& p : panels_) all += p.place.size();
  for (Index P = 0; P < panels();) {  // strip s ends where (s + 1) / strip_count of the pairs are passed
    const std::size_t enough = (strips_.size() + 1) * all;
    Index end = P;
    do passed += panel(end++).place.size();
    while (end < panels() && (all == 0 || passed * strip_count < enough));
    strips_.push_back({P, end});
    P = end;
  }
}

StoredPair SparseSymmetric::pair_at(Index P, std::size_t k) const {
  const Panel& p = panel(P);
  const Index place = p.place[k];
  return {static_cast<Place>(P * panel_rows + place % panel_rows), static_cast<Place>(place / panel_rows), p.K[k],
          p.error_of(k)};
}

std::optional<std::size_t> SparseSymmetric::find(Index a, Index b) const {
  if (a > b) std::swap(a, b);
  const std::vector<Place>& places = panel(a / panel_rows).place;
  const auto place = static_cast<Place>(b * panel_rows + a % panel_rows);
  const auto at = std::lower_bound(places.begin(), places.end(), place);
  if (at == places.end() || *at != place) return std::nullopt;
  return static_cast<std::size_t>(at - places.begin());
}

double SparseSymmetric::entry(Index a, Index b) const {
  const auto at = find(a, b);
  return at ? panel(std::min(a, b) / panel_rows).K[*at] : 0.0;
}

double SparseSymmetric::entry_standard_error(Index a, Index b) const {
  const auto at = find(a, b);
  return at ? panel(std::min(a, b) / panel_rows).error_of(*at) : 0.0;
}

bool SparseSymmetric::has_errors() const {
  return std::any_of(panels_.begin(), panels_.end(), [](const Panel& p) { return !p.error.empty(); }) ||
         std::any_of(dropped_variance_.begin(), dropped_variance_.end(), [](double v) { return v > 0; });
}

template <class Value>
void SparseSymmetric::multiply(const Value& value, solvers::ConstColumns b, solvers::Columns out, Run& run) const {
  const Index columns = b.cols();
  assert(b.rows() == size() && out.rows() == size() && out.cols() == columns);
  // A strip adds to rows of its own and to all after them: sums of its own, from its first row on.
  std::vector<solvers::ColumnMatrix> of_strips(strips_.size());
  run.threads.for_blocks(strips(), 1, [&](Index s, Index) {
    const auto [first, end] = strips_[static_cast<std::size_t>(s)];
    const Index from = first * panel_rows;
    solvers::ColumnMatrix sums = solvers::ColumnMatrix::Zero(size() - from, columns);
    const RowsOf<double> y{sums.data(), columns, from};
    for (Index P = first; P < end; ++P) {
      const Panel& p = panel(P);
      add_pairs(
          p.place, P * panel_rows, [&](std::size_t k) { return value(p, k); }, columns, {b.data(), b.outerStride(), 0},
          y);
    }
    of_strips[static_cast<std::size_t>(s)] = std::move(sums);
  });
  out.setZero();
  for (const solvers::ColumnMatrix& sums : of_strips) out.bottomRows(sums.rows()) += sums;
}

void SparseSymmetric::apply(solvers::ConstColumns b, solvers::Columns out, Run& run) const {
  multiply([](const Panel& p, std::size_t k) { return p.K[k]; }, b, out, run);
}

void SparseSymmetric::apply_variances(solvers::ConstColumns b, solvers::Columns out, Run& run) const {
  const auto squared = [](const Panel& p, std::size_t k) { return p.error_of(k) * p.error_of(k); };
  multiply(squared, b, out, run);
  const Eigen::Map<const Eigen::VectorXd> of_dropped(dropped_variance_.data(), size());
  if (size() > 0) out += of_dropped * b.colwise().maxCoeff();
}

void SparseSymmetric::rows(Index first, Index count, solvers::Columns out) const {
  const Index end = first + count;
  assert(first >= 0 && end <= size() && out.rows() == count && out.cols() == size());
  out.setZero();
  const auto within = [&](Index a) { return a >= first && a < end; };
  const Index last = std::min((end + panel_rows - 1) / panel_rows, panels());
  for (Index P = 0; P < last; ++P) {
    const Panel& p = panel(P);
    const bool before = (P + 1) * panel_rows <= first;  // only what its rows have in columns of these is of interest
    const auto place_of = [](Index column) { return static_cast<Place>(column * panel_rows); };
    const auto begin = before ? std::lower_bound(p.place.begin(), p.place.end(), place_of(first)) : p.place.begin();
    const auto stop = before && end < size() ? std::lower_bound(begin, p.place.end(), place_of(end)) : p.place.end();
    for (auto k = static_cast<std::size_t>(begin - p.place.begin());
         k < static_cast<std::size_t>(stop - p.place.begin()); ++k) {
      const Index a = P * panel_rows + p.place[k] % panel_rows, b = p.place[k] / panel_rows;
      if (within(a)) out(a - first, b) = p.K[k];
      if (within(b)) out(b - first, a) = p.K[k];
    }
  }
  evaluated_.fetch_add(count, std::memory_order_relaxed);
}

void SparseSymmetric::row(Index a, std::vector<solvers::RowEntry>& out) const {
  out.clear();
  const Index own = a / panel_rows;
  const auto first = static_cast<Place>(a * panel_rows), end = static_cast<Place>(first + (panel_rows - 1));
  for (Index P = 0; P < own; ++P) {  // column a of those before
    const Panel& p = panel(P);
    for (auto at = std::lower_bound(p.place.begin(), p.place.end(), first); at != p.place.end() && *at <= end; ++at)
      out.push_back({P * panel_rows + *at % panel_rows, p.K[static_cast<std::size_t>(at - p.place.begin())]});
  }
  const Panel& p = panel(own);
  for (std::size_t k = 0; k < p.place.size(); ++k) {
    const Index i = own * panel_rows + p.place[k] % panel_rows, j = p.place[k] / panel_rows;
    if (j == a || i == a) out.push_back({j == a ? i : j, p.K[k]});
  }
  evaluated_.fetch_add(1, std::memory_order_relaxed);
}

void SparseSymmetric::visit(Index strip, const Visit& visit) const {
  const auto [first, end] = strips_[static_cast<std::size_t>(strip)];
  std::vector<StoredPair> pairs;
  pairs.reserve(pairs_a_visit);
  for (Index P = first; P < end; ++P)
    for (std::size_t k = 0; k < panel(P).place.size(); ++k) {
      pairs.push_back(pair_at(P, k));
      if (pairs.size() < pairs_a_visit) continue;
      visit(pairs);
      pairs.clear();
    }
  if (!pairs.empty()) visit(pairs);
}

void SparseSymmetric::change(const NewEntry& entry, Run& run) {
  run.threads.for_blocks(panels(), 1, [&](Index P, Index) {
    for (std::size_t k = 0; k < panel(P).place.size(); ++k)
      panels_[static_cast<std::size_t>(P)].K[k] = entry(pair_at(P, k));
  });
  for (Index a = 0; a < size(); ++a) self_[static_cast<std::size_t>(a)] = this->entry(a, a);
}

std::unique_ptr<SymmetricOperator> SparseSymmetric::alike(std::vector<double> areas, const Fill& fill, Run& run) const {
  SparseAssembly assembly(std::move(areas), 0);
  fill(assembly);
  return assembly.packed(run);
}

double SparseSymmetric::bytes() const {
  std::size_t bytes = 0;
  for (const Panel& p : panels_)
    bytes += p.place.size() * sizeof(Place) + p.K.size() * sizeof(double) + p.error.size() * sizeof(float);
  return static_cast<double>(bytes);
}

double SparseSymmetric::kept_share() const {
  std::size_t kept = 0;
  for (const Panel& p : panels_) kept += p.place.size();
  for (Index a = 0; a < size(); ++a) kept -= find(a, a).has_value();
  const auto n = static_cast<double>(size());
  return n > 1 ? static_cast<double>(kept) / (0.5 * n * (n - 1)) : 1.0;
}

SparseAssembly::SparseAssembly(std::vector<double> areas, double drop_below)
    : areas_(std::move(areas)),
      drop_below_(drop_below),
      panels_((areas_.size() + panel_rows - 1) / panel_rows),
      dropped_(areas_.size()),
      dropped_variance_(areas_.size()) {
  if (areas_.size() > std::size_t{1} << 26)
    throw core::InputError(core::format("a sparse operator of %zu elements", areas_.size()),
                           "67 108 864 at most expected");
}

void SparseAssembly::drop(Index a, const ExchangeEntry& entry) {
  const auto row = static_cast<std::size_t>(a);
  const double noise = entry.standard_error / areas_[row];
  add_units(dropped_[row], (entry.K + entry.bound) / areas_[row], factor_unit);
  if (noise > 0) add_units(dropped_variance_[row], noise * noise, variance_unit);
}

void SparseAssembly::add(Index a, Index b, const ExchangeEntry& entry) {
  assert(a >= 0 && b >= 0 && std::max(a, b) < static_cast<Index>(areas_.size()) && std::isfinite(entry.K));
  if (a > b) std::swap(a, b);
  if (entry.K == 0 && entry.standard_error == 0 && entry.bound == 0) return;
  if (entry.K < drop_below_ * std::min(areas_[static_cast<std::size_t>(a)], areas_[static_cast<std::size_t>(b)])) {
    drop(a, entry);
    if (a != b) drop(b, entry);
    return;
  }
  if (entry.K == 0 && entry.standard_error == 0) return;
  Rows& panel = panels_[static_cast<std::size_t>(a / panel_rows)];
  const std::scoped_lock lock(panel.mutex);
  panel.entries.push_back({entry.K, static_cast<SparseSymmetric::Place>(b * panel_rows + a % panel_rows),
                           static_cast<float>(entry.standard_error)});
}

/// In order; of a pair that was added several times the last.
SparseSymmetric::Panel SparseAssembly::packed(std::deque<Entry> entries) {
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& x, const Entry& y) { return x.place < y.place; });
  std::size_t count = 0;
  bool errors = false;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    if (k + 1 < entries.size() && entries[k + 1].place == entries[k].place) continue;
    errors = errors || entries[k].error != 0;
    entries[count++] = entries[k];
  }
  SparseSymmetric::Panel panel;
  panel.place.reserve(count);
  panel.K.reserve(count);
  if (errors) panel.error.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    panel.place.push_back(entries[k].place);
    panel.K.push_back(entries[k].K);
    if (errors) panel.error.push_back(entries[k].error);
  }
  return panel;
}

std::unique_ptr<SparseSymmetric> SparseAssembly::packed(const Run& run) {
  std::unique_ptr<SparseSymmetric> K(new SparseSymmetric(std::move(areas_), drop_below_));
  run.threads.for_blocks(K->panels(), 1, [&](Index P, Index) {
    const auto at = static_cast<std::size_t>(P);
    K->panels_[at] = packed(std::exchange(panels_[at].entries, {}));
  });
  for (std::size_t a = 0; a < dropped_.size(); ++a) {
    const double area = K->areas_[a];
    K->dropped_.push_back(factor_unit * static_cast<double>(dropped_[a].load()));
    K->dropped_variance_.push_back(variance_unit * static_cast<double>(dropped_variance_[a].load()) * area * area);
    K->self_[a] = K->entry(static_cast<Index>(a), static_cast<Index>(a));
  }
  K->cut_into_strips();
  return K;
}

}  // namespace interflect::fem
