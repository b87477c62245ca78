#include "fem/form_factor/hemisphere_rays.h"

#include <algorithm>
#include <cmath>

#include "core/hemisphere.h"
#include "core/random.h"
#include "fem/form_factor/counted_exchange.h"
#include "fem/form_factor/orientation.h"

namespace interflect::fem {
namespace {

constexpr std::uint64_t batch = 1024, most_rays = 1 << 16;

}  // namespace

/// The hits of one row after the other; its memory is reused.
class HemisphereRays::Row {
 public:
  explicit Row(const HemisphereRays& method) : m_(method), hits_(method.context_.patches.size(), 0) {}

  void begin(Index a) {
    for (const Index b : hit_) hits_[static_cast<std::size_t>(b)] = 0;
    hit_.clear();
    rays_ = 0;
    a_ = a;
    frame_ = core::frame_around(m_.shapes_[a].plane.normal);
    shift_ = core::random_block(m_.seed_, static_cast<std::uint32_t>(a), ~std::uint64_t{0}, 0);
  }

  /// Rays up to number `end`, which ray k is depends on (seed, a, k) alone.
  void extend(std::uint64_t end) {
    for (; rays_ < end; ++rays_) {
      core::RandomNumbers random(m_.seed_, static_cast<std::uint32_t>(a_), rays_);
      const double u = random.next(), v = random.next();
      const auto word = m_.sequence_.point<2>(static_cast<std::uint32_t>(rays_));
      const Vec3 x = m_.maps_[static_cast<std::size_t>(a_)](core::inside_unit(word[0] ^ shift_[0]),
                                                            core::inside_unit(word[1] ^ shift_[1]));
      count(m_.context_.rays.closest(
          {x + m_.shapes_.origin(), frame_.to_world(core::cosine_hemisphere(u, v)), frame_.n}));
    }
  }

  /// (sum_b F_ab (1 - F_ab) / n + 1 / (n + 2)²)^1/2
  double error() const {
    const auto n = static_cast<double>(rays_);
    double sum = 0;
    for (const Index b : hit_) {
      const double F = static_cast<double>(hits(b)) / n;
      sum += F * (1 - F);
    }
    return std::sqrt(sum / n + 1 / ((n + 2) * (n + 2)));
  }

  std::uint64_t hits(Index b) const { return hits_[static_cast<std::size_t>(b)]; }
  std::uint64_t rays() const { return rays_; }

 private:
  void count(const std::optional<scene::SurfacePoint>& hit) {
    if (!hit) return;
    const Index b = m_.locate_(*hit);
    if (b != ElementLocator::none && hits_[static_cast<std::size_t>(b)]++ == 0) hit_.push_back(b);
  }

  const HemisphereRays& m_;
  Index a_ = 0;
  core::Frame frame_{};
  core::RandomBlock shift_{};
  std::vector<std::uint64_t> hits_;
  std::vector<Index> hit_;  ///< elements with hits
  std::uint64_t rays_ = 0;
};

HemisphereRays::HemisphereRays(const FormFactorContext& context)
    : context_(context),
      seed_(core::derived_seed(context.seed, "hemisphere-rays")),
      shapes_(context.patches),
      locate_(context.patches),
      sequence_(core::Sobol::scrambled(seed_)) {
  for (Index i = 0; i < static_cast<Index>(context.patches.size()); ++i) maps_.emplace_back(shapes_[i].ring());
}

PairCounts HemisphereRays::exchange(const ElementBlock& rows, const ElementBlock& columns, ExchangeSink& sink,
                                    const Run& run) const {
  PairCounts counts;
  Row row(*this);
  for (Index a = rows.first; a < rows.first + rows.count; ++a) {
    row.begin(a);
    do {
      run.throw_if_stopped("form factors");
      row.extend(context_.samples == 0 ? row.rays() + batch
                                       : std::min(context_.samples, row.rays() + (std::uint64_t{1} << 20)));
    } while (context_.samples == 0 ? row.error() > context_.tolerance && row.rays() < most_rays
                                   : row.rays() < context_.samples);
    counts.rays += row.rays();
    const double area = shapes_[a].area;
    sink.weigh_row(a, static_cast<double>(row.rays()) / area);
    for (Index b = columns.first; b < columns.first + columns.count; ++b) {
      if (b == a && !context_.by_mirrors) continue;
      if (!context_.by_mirrors && facing_away(shapes_, a, b)) {
        ++counts.facing_away;
        continue;
      }
      ++counts.sampled;
      sink.add(a, b, counted_exchange(row.hits(b), row.rays(), area, most_exchange(context_.patches, a, b), counts));
    }
  }
  return counts;
}

}  // namespace interflect::fem
