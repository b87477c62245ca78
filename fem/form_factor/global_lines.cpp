#include "fem/form_factor/global_lines.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/hemisphere.h"
#include "core/random.h"
#include "core/seconds_since.h"
#include "fem/form_factor/counted_exchange.h"
#include "fem/form_factor/orientation.h"

namespace interflect::fem {
namespace {

constexpr Index lines_a_block = 4096, rows_a_block = 4;
constexpr double most_lines_an_element = 1 << 14;

scene::Side other(scene::Side side) { return side == scene::Side::front ? scene::Side::back : scene::Side::front; }

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
  void add(const Pair& pair) { count_[at(pair.from, pair.to)].fetch_add(1, std::memory_order_relaxed); }
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
      centre_(shapes_.origin()) {
  double area = 0;
  for (const scene::SurfacePatch& patch : context.patches) {
    for (const Vec3& corner : patch.ring()) radius_ = std::max(radius_, (corner - centre_).norm());
    area += patch.area;
  }
  const double an_element = std::min(1 / (context.tolerance * context.tolerance), most_lines_an_element);
  const double mean_area = area / static_cast<double>(context.patches.size());
  lines_ = context.samples;
  if (lines_ == 0 && area > 0)
    lines_ = static_cast<std::uint64_t>(std::ceil(an_element * 2 * pi * radius_ * radius_ / mean_area));
}

raycast::Ray GlobalLines::line(std::uint64_t k) const {
  core::RandomNumbers random(seed_, 0, k);
  const double u = random.next(), v = random.next(), s = random.next(), t = random.next();
  const double z = 1 - 2 * u, across = std::sqrt(std::max(0.0, 1 - z * z)), from_axis = radius_ * std::sqrt(s);
  const Vec3 direction(across * std::cos(2 * pi * v), across * std::sin(2 * pi * v), z);
  const core::Frame frame = core::frame_around(direction);
  return {
      centre_ + frame.to_world({from_axis * std::cos(2 * pi * t), from_axis * std::sin(2 * pi * t), -1.5 * radius_}),
      direction};
}

void GlobalLines::pairs_along(const raycast::Ray& line, std::vector<scene::SurfacePoint>& hits,
                              std::vector<Pair>& pairs) const {
  pairs.clear();
  context_.rays.all(line, hits);
  for (std::size_t k = 1; k < hits.size(); ++k) {
    const scene::SurfacePoint& to = hits[k];
    // Surfaces that lie on each other do not exchange light through the nothing between them; nor do rays see each
    // other there.
    if ((to.position - hits[k - 1].position).norm() <= 2 * context_.rays.offset()) continue;
    scene::SurfacePoint from = hits[k - 1];
    from.side = other(from.side);
    const Index i = locate_(from);
    if (i == ElementLocator::none) continue;
    const Index j = locate_(to);
    if (j != ElementLocator::none && j != i) pairs.push_back({i, j});
  }
}

void GlobalLines::shoot(std::uint64_t begin, std::uint64_t end, Counts& found) const {
  std::vector<scene::SurfacePoint> hits;
  std::vector<Pair> pairs;
  for (std::uint64_t k = begin; k < end; ++k) {
    pairs_along(line(k), hits, pairs);
    for (const Pair& pair : pairs) found.add(pair);
  }
}

PairCounts GlobalLines::add_row(Index a, const Counts& found, ExchangeSink& sink) const {
  PairCounts counts;
  const double whole = 2 * pi * radius_ * radius_;
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
