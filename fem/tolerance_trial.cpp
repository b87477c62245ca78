#include "fem/tolerance_trial.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/estimate.h"
#include "core/random.h"
#include "core/seconds_since.h"

namespace interflect::fem {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double longest = 2;  // [s] after which no more rows are tried
constexpr Index most_rows = 64, most_entries = 384, neighbours = 8;

/// The errors of one row's entries [m²].
class RowSink final : public ExchangeSink {
 public:
  RowSink(Index row, Index elements) : row_(row), error_(static_cast<std::size_t>(elements), 0) {}
  void add(Index a, Index b, const ExchangeEntry& entry) override {
    error_[static_cast<std::size_t>(a == row_ ? b : a)] = entry.bound + normal_95 * entry.standard_error;
  }
  double error(Index b) const { return error_[static_cast<std::size_t>(b)]; }
  /// Of the entries that were tried: their sum, less what chance may have made of it, if they stand for others.
  double certain_sum(bool all) const {
    double sum = 0, squares = 0;
    for (const double e : error_) sum += e, squares += e * e;
    return all ? sum : sum - 2 * std::sqrt(squares);
  }

 private:
  Index row_;
  std::vector<double> error_;
};

class Trial {
 public:
  Trial(const MethodMaker& make, double tolerance, std::span<const scene::SurfacePatch> patches, AgainPart part,
        const Run& run)
      : make_(make),
        tolerance_(tolerance),
        patches_(patches),
        part_(part),
        run_(run),
        random_(core::derived_seed(run.seed, "later passes"), 0, 0),
        size_(static_cast<Index>(patches.size())) {}

  /// Only pair methods can be asked for rows again.
  bool is_of_pairs() { return method(0).granularity() == FormFactorMethod::Granularity::pair; }

  /// Of a random row, were all its entries tried [s]; 0 where its first pass will do.
  double next_row() {
    const auto row = static_cast<Index>(random_.next() * static_cast<double>(size_));
    const std::vector<Index> columns = some_columns();
    const double scale = static_cast<double>(size_) / static_cast<double>(columns.size()),
                 may_err = tolerance_ * patches_[static_cast<std::size_t>(row)].area;
    RowSink sink(row, size_);
    exchange(0, row, columns, sink);
    const auto misses = [&] { return scale * sink.certain_sum(std::ssize(columns) == size_) > may_err; };
    if (!misses()) return 0;
    const Clock::time_point start = Clock::now();
    for (int pass = 1; pass < most_passes && misses(); ++pass)
      exchange(pass, row, to_do_again(row, columns, sink), sink);
    return scale * core::seconds_since(start);
  }

 private:
  /// Of the later passes each is made when it is needed.
  const FormFactorMethod& method(int pass) {
    while (std::ssize(methods_) <= pass)
      methods_.push_back(make_(entry_tolerance(tolerance_, static_cast<int>(methods_.size()))));
    return *methods_[static_cast<std::size_t>(pass)];
  }
  /// A few neighbours here and there, since neighbours share their proofs.
  std::vector<Index> some_columns() {
    const Index runs = std::min(most_entries, size_) / neighbours;
    std::vector<Index> columns;
    if (runs == 0) {
      columns.resize(static_cast<std::size_t>(size_));
      std::iota(columns.begin(), columns.end(), Index{0});
    }
    for (Index k = 0; k < runs; ++k) {
      const double room = static_cast<double>(size_) / static_cast<double>(runs) - neighbours;
      const auto first =
          static_cast<Index>(static_cast<double>(size_ * k) / static_cast<double>(runs) + random_.next() * room);
      for (Index b = first; b < first + neighbours; ++b) columns.push_back(b);
    }
    return columns;
  }
  std::vector<Index> to_do_again(Index row, const std::vector<Index>& columns, const RowSink& sink) const {
    if (part_ == AgainPart::rows) return columns;
    const double least = negligible_error(tolerance_, patches_[static_cast<std::size_t>(row)].area, size_);
    std::vector<Index> out;
    std::copy_if(columns.begin(), columns.end(), std::back_inserter(out),
                 [&](Index b) { return sink.error(b) > least; });
    return out;
  }
  /// Neighbours in one call.
  void exchange(int pass, Index row, const std::vector<Index>& columns, RowSink& sink) {
    const FormFactorMethod& by = method(pass);
    for (std::size_t from = 0, to = 0; from < columns.size(); from = to) {
      run_.throw_if_stopped("forecast");
      while (to < columns.size() && columns[to] - columns[from] == static_cast<Index>(to - from)) ++to;
      const Index first = columns[from], end = columns[to - 1] + 1;
      if (first < row) by.exchange({patches_, first, std::min(end, row) - first}, {patches_, row, 1}, sink, run_);
      const Index after = std::max(first, row + 1);
      if (after < end) by.exchange({patches_, row, 1}, {patches_, after, end - after}, sink, run_);
    }
  }

  const MethodMaker& make_;
  double tolerance_;
  std::span<const scene::SurfacePatch> patches_;
  AgainPart part_;
  const Run& run_;
  core::RandomNumbers random_;
  Index size_;
  std::vector<std::unique_ptr<FormFactorMethod>> methods_;
};

}  // namespace

double seconds_of_later_passes(const MethodMaker& make, double tolerance, std::span<const scene::SurfacePatch> patches,
                               AgainPart part, const Run& run) {
  Trial trial(make, tolerance, patches, part, run);
  if (!trial.is_of_pairs()) return 0;
  const auto size = static_cast<Index>(patches.size());
  const Clock::time_point start = Clock::now();
  double seconds = 0;
  Index rows = 0, again = 0;
  for (; rows < std::min(size, most_rows) && core::seconds_since(start) <= longest; ++rows) {
    const double of_row = trial.next_row();
    seconds += of_row;
    again += of_row > 0;
  }
  const double mean = seconds / static_cast<double>(rows),
               share = static_cast<double>(again) / static_cast<double>(rows);
  // Where whole rows are done again, what two of them have in common is done once.
  return static_cast<double>(size) * mean * (part == AgainPart::rows ? 1 - 0.5 * share : 1);
}

}  // namespace interflect::fem
