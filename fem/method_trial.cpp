#include "fem/method_trial.h"

#include <algorithm>

#include "core/random.h"
#include "core/seconds_since.h"

namespace interflect::fem {

namespace {

class Discard final : public ExchangeSink {
 public:
  void add(Index, Index, const ExchangeEntry&) override {}
};

constexpr double longest = 2;  // [s] after which no more is tried

/// Random blocks of so many rows and columns, while there is time left.
double by_blocks(const FormFactorMethod& method, std::span<const scene::SurfacePatch> patches, Index count,
                 double time_left, const Run& run) {
  constexpr Index blocks = 24;
  const Index room = static_cast<Index>(patches.size()) - count + 1;
  core::RandomNumbers random(core::derived_seed(run.seed, "forecast"), 0, 0);
  Discard sink;
  double pairs = 0;
  const auto start = std::chrono::steady_clock::now();
  for (Index k = 0; k < blocks && core::seconds_since(start) <= time_left; ++k) {
    run.throw_if_stopped("forecast");
    auto row = static_cast<Index>(random.next() * static_cast<double>(room)),
         column = static_cast<Index>(random.next() * static_cast<double>(room));
    if (row > column) std::swap(row, column);
    const PairCounts c = method.exchange({patches, row, count}, {patches, column, count}, sink, run);
    pairs += static_cast<double>(c.facing_away + c.clear + c.sampled + c.subtracted);
  }
  return core::seconds_since(start) / std::max(pairs, 1.0);
}

/// Blocks as large as time allows: in large ones pairs share their proofs, and some pairs take a second each.
double by_blocks(const FormFactorMethod& method, std::span<const scene::SurfacePatch> patches, const Run& run) {
  const Index most = std::clamp<Index>(static_cast<Index>(patches.size()) / 16, 1, 48);
  const auto start = std::chrono::steady_clock::now();
  double seconds = 0;
  for (Index count = std::min<Index>(most, 3); count <= most && core::seconds_since(start) <= 0.25 * longest;
       count *= 4)
    seconds = by_blocks(method, patches, count, longest - core::seconds_since(start), run);
  return seconds;
}

/// A few random rows: each is worth half as many pairs as it has entries.
double by_rows(const FormFactorMethod& method, std::span<const scene::SurfacePatch> patches, const Run& run) {
  const auto n = static_cast<Index>(patches.size());
  const int most = static_cast<int>(std::clamp<Index>(n / 16, 1, 8));
  core::RandomNumbers random(core::derived_seed(run.seed, "forecast"), 0, 0);
  Discard sink;
  const auto start = std::chrono::steady_clock::now();
  int rows = 0;
  for (; rows < most && core::seconds_since(start) <= longest; ++rows) {
    run.throw_if_stopped("forecast");
    const auto row = static_cast<Index>(random.next() * static_cast<double>(n));
    method.exchange({patches, row, 1}, {patches, 0, n}, sink, run);
  }
  return core::seconds_since(start) / (0.5 * rows * static_cast<double>(n));
}

}  // namespace

double seconds_per_pair(const FormFactorMethod& method, std::span<const scene::SurfacePatch> patches, const Run& run) {
  using Granularity = FormFactorMethod::Granularity;
  if (method.granularity() == Granularity::pair) return by_blocks(method, patches, run);
  if (method.granularity() == Granularity::row) return by_rows(method, patches, run);
  const auto n = static_cast<double>(patches.size());
  return method.trial(run) / (0.5 * n * n);
}

double seconds_per_point(const PointViewFactors& factors, std::span<const measure::PointIrradiance> points) {
  if (points.empty()) return 0;
  const std::size_t tried = std::min<std::size_t>(points.size(), 4);
  std::vector<double> F(static_cast<std::size_t>(factors.elements())), error(F.size());
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t k = 0; k < tried; ++k) factors(points[k * points.size() / tried], F, error);
  return core::seconds_since(start) / static_cast<double>(tried);
}

}  // namespace interflect::fem
