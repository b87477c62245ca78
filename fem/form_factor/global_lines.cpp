#include "fem/form_factor/global_lines.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/random.h"
#include "core/seconds_since.h"
#include "fem/form_factor/counted_exchange.h"
#include "fem/form_factor/orientation.h"

namespace interflect::fem {
namespace {

constexpr Index lines_a_block = 4096, rows_a_block = 4;
constexpr double most_lines_an_element = 1 << 14;

class Discard final : public ExchangeSink {
 public:
  void add(Index, Index, const ExchangeEntry&) override {}
};

}  // namespace

/// N_ij, each pair once: whole numbers, so that the order in which threads add does not show.  2 N² bytes.
class GlobalLines::Counts {
 public:
  explicit Counts(Index elements)
      : elements_(elements), count_(static_cast<std::size_t>(elements * (elements - 1) / 2)) {}
  void add(const LinesThrough::Exchange& pair) {
    count_[at(pair.from, pair.to)].fetch_add(1, std::memory_order_relaxed);
  }
  std::uint32_t operator()(Index a, Index b) const { return count_[at(a, b)].load(std::memory_order_relaxed); }

 private:
  std::size_t at(Index a, Index b) const {
    if (a > b) std::swap(a, b);
    return static_cast<std::size_t>(a * (2 * elements_ - a - 1) / 2 + (b - a - 1));
  }

  Index elements_;
  std::vector<std::atomic<std::uint32_t>> count_;
};

GlobalLines::GlobalLines(const FormFactorContext& context)
    : context_(context),
      seed_(core::derived_seed(context.seed, "global-lines")),
      shapes_(context.patches),
      locate_(context.patches),
      through_(context.patches, context.rays, locate_) {
  double area = 0;
  for (const scene::SurfacePatch& patch : context.patches) area += patch.area;
  const double an_element = std::min(1 / (context.tolerance * context.tolerance), most_lines_an_element);
  const double mean_area = area / static_cast<double>(context.patches.size());
  lines_ = context.samples;
  if (lines_ == 0 && area > 0)
    lines_ = static_cast<std::uint64_t>(std::ceil(an_element * .5 * through_.measure() / mean_area));
}

raycast::Ray GlobalLines::line(std::uint64_t k) const {
  core::RandomNumbers random(seed_, 0, k);
  double u[4];
  for (double& each : u) each = random.next();
  return through_.line(u);
}

void GlobalLines::shoot(std::uint64_t begin, std::uint64_t end, Counts& found) const {
  std::vector<scene::SurfacePoint> hits;
  std::vector<LinesThrough::Exchange> pairs;
  for (std::uint64_t k = begin; k < end; ++k) {
    through_.pairs_along(line(k), hits, pairs);
    for (const LinesThrough::Exchange& pair : pairs) found.add(pair);
  }
}

PairCounts GlobalLines::add_row(Index a, const Counts& found, ExchangeSink& sink) const {
  PairCounts counts;
  const double whole = .5 * through_.measure();
  for (Index b = a + 1; b < static_cast<Index>(context_.patches.size()); ++b) {
    if (facing_away(shapes_, a, b)) {
      ++counts.facing_away;
      continue;
    }
    ++counts.sampled;
    sink.add(a, b, counted_exchange(found(a, b), lines_, whole, most_exchange(context_.patches, a, b), counts));
  }
  return counts;
}

PairCounts GlobalLines::exchange(const ElementBlock& rows, const ElementBlock&, ExchangeSink& sink,
                                 const Run& run) const {
  const Index n = rows.count, blocks = static_cast<Index>((lines_ + lines_a_block - 1) / lines_a_block);
  if (n < 2) return {};
  Counts found(n);
  {
    core::Progress::Stage stage(run.progress, "lines", lines_);
    run.threads.for_blocks(blocks, 1, [&](Index block, Index) {
      run.throw_if_stopped("form factors");
      const auto begin = static_cast<std::uint64_t>(block * lines_a_block),
                 end = std::min(lines_, begin + lines_a_block);
      shoot(begin, end, found);
      stage.advance(end - begin);
    });
  }
  PairCounts counts = core::reduce_in_blocks(run.threads, n, rows_a_block, PairCounts{}, [&](Index begin, Index end) {
    run.throw_if_stopped("form factors");
    PairCounts of_rows;
    for (Index a = begin; a < end; ++a) of_rows += add_row(a, found, sink);
    return of_rows;
  });
  counts.rays += lines_;
  return counts;
}

double GlobalLines::trial(const Run& run) const {
  const auto n = static_cast<Index>(context_.patches.size());
  if (n < 2 || lines_ == 0) return 0;
  const std::uint64_t tried = std::min<std::uint64_t>(lines_, 4 * lines_a_block);
  Counts found(n);
  shoot(0, 1, found);  // what a caster makes at its first line is not counted for each
  const auto start = std::chrono::steady_clock::now();
  for (std::uint64_t begin = 0; begin < tried; begin += lines_a_block) {
    run.throw_if_stopped("forecast");
    shoot(begin, std::min(tried, begin + lines_a_block), found);
  }
  const double lines = core::seconds_since(start) * static_cast<double>(lines_) / static_cast<double>(tried);

  constexpr Index rows_tried = 8;
  Discard sink;
  const auto start_of_rows = std::chrono::steady_clock::now();
  double pairs = 0;
  for (Index k = 0; k < rows_tried; ++k) {
    const Index a = k * (n - 1) / rows_tried;
    add_row(a, found, sink);
    pairs += static_cast<double>(n - 1 - a);
  }
  return lines + core::seconds_since(start_of_rows) * 0.5 * static_cast<double>(n) * static_cast<double>(n - 1) / pairs;
}

}  // namespace interflect::fem
