#include "fem/form_factor/area_to_area.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/random.h"
#include "fem/form_factor/counted_exchange.h"
#include "fem/form_factor/orientation.h"
#include "fem/form_factor/seen_element.h"

namespace interflect::fem {
namespace {

constexpr std::uint32_t fewest_points = 8, most_points = 1024;  ///< of one randomisation
/// Nearer than so many sums of their radii, points of the second element are drawn by solid angle.
constexpr double near = 2.0;

double squared(double x) { return x * x; }

}  // namespace

/// One pair at a time; its memory is reused.
class AreaToArea::Sampling {
 public:
  explicit Sampling(const AreaToArea& method) : m_(method) {}

  void begin(Index i, Index j) {
    const ElementShape &a = m_.shapes_[i], &b = m_.shapes_[j];
    const bool swapped = b.area < a.area;
    from_ = swapped ? &b : &a, to_ = swapped ? &a : &b;
    from_map_ = &m_.maps_[static_cast<std::size_t>(swapped ? j : i)],
    to_map_ = &m_.maps_[static_cast<std::size_t>(swapped ? i : j)];
    most_ = most_exchange(m_.context_.patches, i, j);
    by_solid_angle_ = (a.centroid - b.centroid).norm() < near * (a.radius + b.radius);
    clear_ = !m_.blockers_.any(geometry::Shaft(a.ring(), b.ring(), m_.shapes_.plane_tolerance()));
    for (std::uint32_t r = 0; r < randomisations; ++r)
      shift_[r] = core::random_block(m_.seed_, static_cast<std::uint32_t>(i),
                                     static_cast<std::uint64_t>(j) * randomisations + r, 0);
    seen_.fill(0);
    done_ = rays_ = blocked_rays_ = 0;
    sum_ = squares_ = 0;
  }

  /// Points up to number `points` of every randomisation.
  void extend(std::uint32_t points) {
    segments_.clear();
    for (std::uint32_t r = 0; r < randomisations; ++r)
      for (std::uint32_t k = done_; k < points; ++k) sample(r, k);
    done_ = points;
    if (!clear_) cast();
  }

  double unoccluded() const { return sum_ / samples(); }

  ExchangeEntry entry(PairCounts& counts) const {
    const double R = randomisations, points = done_;
    double mean = 0, scatter = 0;
    for (const double sum : seen_) mean += sum / points / R;
    for (const double sum : seen_) scatter += squared(sum / points - mean);
    const double noise = std::sqrt((R - 1) / (R - 3) * scatter / (R * (R - 1)));
    counts.clamped += mean > most_;
    return {std::min(mean, most_), std::min(std::hypot(noise, unproved()), most_), 0};
  }

  bool clear() const { return clear_; }
  std::uint64_t rays() const { return rays_; }

 private:
  struct Pending {
    double weight;
    std::uint32_t randomisation;
  };

  double samples() const { return static_cast<double>(done_) * randomisations; }

  /// A pair of points with its weight, and the ray between them if one is needed.
  void sample(std::uint32_t r, std::uint32_t k) {
    const auto word = m_.sequences_[r].point<4>(k);
    const auto number = [&](std::size_t d) { return core::inside_unit(word[d] ^ shift_[r][d]); };
    const Vec3 x = (*from_map_)(number(0), number(1));
    Vec3 y = x;
    const double u = number(2), v = number(3);
    const double weight = by_solid_angle_ ? weight_in_solid_angle(x, u, v, y) : weight_by_area(x, u, v, y);
    if (!(weight > 0)) return;
    sum_ += weight;
    squares_ += weight * weight;
    if (clear_) {
      seen_[r] += weight;
      return;
    }
    segments_.push_back({x + m_.shapes_.origin(), y + m_.shapes_.origin(), from_->plane.normal, to_->plane.normal});
    pending_.push_back({weight, r});
  }

  double weight_by_area(const Vec3& x, double u, double v, Vec3& y) const {
    y = (*to_map_)(u, v);
    const Vec3 d = y - x;
    const double leaves = from_->plane.normal.dot(d), arrives = -to_->plane.normal.dot(d);
    if (leaves <= 0 || arrives <= 0) return 0;
    return from_->area * to_->area * leaves * arrives / (pi * squared(d.squaredNorm()));
  }

  double weight_in_solid_angle(const Vec3& x, double u, double v, Vec3& y) const {
    const SeenElement seen(x, to_->ring());
    if (seen.solid_angle() == 0) return 0;
    const Vec3 direction = seen.direction(u, v);
    const double arrives = -to_->plane.normal.dot(direction);
    if (!(arrives > 0)) return 0;
    y = x + to_->plane.distance(x) / arrives * direction;
    return from_->area * seen.solid_angle() * std::max(0.0, from_->plane.normal.dot(direction)) / pi;
  }

  void cast() {
    blocked_.resize(segments_.size());
    m_.context_.rays.occluded(segments_, blocked_);
    for (std::size_t k = 0; k < segments_.size(); ++k)
      if (blocked_[k] == 0)
        seen_[pending_[k].randomisation] += pending_[k].weight;
      else
        ++blocked_rays_;
    rays_ += segments_.size();
    pending_.clear();
  }

  /// What rays that all agree leave open; and what points leave open none of which found anything.
  double unproved() const {
    if (sum_ == 0) return from_->area / (samples() + 2);
    if (clear_ || (blocked_rays_ > 0 && blocked_rays_ < rays_)) return 0;
    const auto n = static_cast<double>(rays_);
    return unoccluded() * std::sqrt((n + 1) * squares_) / ((n + 2) * sum_);
  }

  const AreaToArea& m_;
  const ElementShape *from_ = nullptr, *to_ = nullptr;
  const UniformMap *from_map_ = nullptr, *to_map_ = nullptr;
  double most_ = 0;
  bool by_solid_angle_ = false, clear_ = false;
  std::array<core::RandomBlock, randomisations> shift_;
  std::array<double, randomisations> seen_{};  ///< sums of visible weights
  std::uint32_t done_ = 0;                     ///< points of each randomisation
  std::uint64_t rays_ = 0, blocked_rays_ = 0;
  double sum_ = 0, squares_ = 0;  ///< of all weights
  std::vector<raycast::Segment> segments_;
  std::vector<Pending> pending_;
  std::vector<std::uint8_t> blocked_;
};

AreaToArea::AreaToArea(const FormFactorContext& context)
    : context_(context),
      seed_(core::derived_seed(context.seed, "area-to-area")),
      shapes_(context.patches),
      blockers_(context.scene, shapes_.origin(), shapes_.plane_tolerance()) {
  for (Index i = 0; i < static_cast<Index>(context.patches.size()); ++i) maps_.emplace_back(shapes_[i].ring());
  for (std::uint32_t r = 0; r < randomisations; ++r) sequences_.push_back(core::Sobol::scrambled(seed_ + r));
}

PairCounts AreaToArea::exchange(const ElementBlock& rows, const ElementBlock& columns, ExchangeSink& sink,
                                const Run& run) const {
  PairCounts counts;
  Sampling sampling(*this);
  for (Index i = rows.first; i < rows.first + rows.count; ++i) {
    run.throw_if_stopped("form factors");
    for (Index j = std::max(columns.first, i + 1); j < columns.first + columns.count; ++j) {
      if (facing_away(shapes_, i, j)) {
        ++counts.facing_away;
        continue;
      }
      sink.add(i, j, estimate(i, j, sampling, counts, run));
    }
  }
  return counts;
}

ExchangeEntry AreaToArea::estimate(Index i, Index j, Sampling& sampling, PairCounts& counts, const Run& run) const {
  const bool adaptive = context_.samples == 0;
  const auto asked = (context_.samples + randomisations - 1) / randomisations;
  const auto last =
      adaptive ? most_points : static_cast<std::uint32_t>(std::bit_ceil(std::clamp<std::uint64_t>(asked, 1, 1u << 26)));
  ExchangeEntry entry;
  sampling.begin(i, j);
  for (std::uint32_t points = adaptive ? fewest_points : std::min(last, most_points);;
       points += std::min(points, most_points)) {
    run.throw_if_stopped("form factors");
    sampling.extend(points);
    PairCounts of_entry;
    entry = sampling.entry(of_entry);
    if (points < last && !(adaptive && entry.standard_error <= context_.tolerance * sampling.unoccluded())) continue;
    counts.clamped += of_entry.clamped;
    break;
  }
  sampling.clear() ? ++counts.clear : ++counts.sampled;
  counts.rays += sampling.rays();
  return entry;
}

}  // namespace interflect::fem
