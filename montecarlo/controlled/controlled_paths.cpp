#include "montecarlo/controlled/controlled_paths.h"

#include <algorithm>
#include <vector>

#include "montecarlo/roulette.h"

namespace interflect::montecarlo {
/// Vertex by vertex, as PathEstimator's: their rays go to the ray caster together.
class ControlledPaths::Wave {
 public:
  static constexpr std::size_t most = 64;  ///< that stay in the nearest cache

  Wave(const ControlledPaths& of, const PathEstimator::Keys& keys, std::size_t count)
      : of_(of), on_(of.paths_), keys_(keys), paths_(std::min(most, count)) {
    const std::size_t n = paths_.size();
    live_.reserve(n), indices_.reserve(n), numbers_.reserve(n * numbers_per_vertex);
    segments_.reserve(n), blocked_.reserve(n), candidates_.reserve(n), rays_.reserve(n), met_.reserve(n);
  }

  /// Of samples keys.first + first on.
  void begin(std::size_t first) {
    first_ = first;
    live_.clear();
    const PathEstimator::Carried nothing = on_.from_eye();
    for (Path& path : paths_) {
      path.carried = nothing;
      path.known = path.control = Spectrum::zero();
      path.expected = 0;
    }
  }
  void start(std::size_t k, const Receiver& at, double expected) {
    paths_[k].at = on_.receiving(at);
    paths_[k].expected = expected * inv_pi;
    live_.push_back(static_cast<std::uint32_t>(k));
  }
  void start(std::span<const std::optional<raycast::Ray>> from_eye) {
    for (std::size_t k = 0; k < from_eye.size(); ++k) {
      if (!from_eye[k]) continue;
      paths_[k].drawn = {*from_eye[k], {from_eye[k]->origin, Vec3::Zero()}, 0};
      live_.push_back(static_cast<std::uint32_t>(k));
    }
    arrive();
    for (const std::uint32_t k : live_)
      paths_[k].expected = on_.scene().weigh(paths_[k].carried.found + paths_[k].known);
  }
  void follow(std::uint32_t block) {
    for (; !live_.empty(); block += PathEstimator::blocks_per_vertex) {
      draw(block);
      scatter();
      light();
      arrive();
    }
  }
  Found found(std::size_t k, double scale) const {
    return {scale * paths_[k].carried.found, scale * paths_[k].control};
  }

 private:
  struct Path {
    PathEstimator::Vertex at{};
    PathEstimator::Carried carried{};
    PathEstimator::Drawn drawn{{}, {}, 0};
    Spectrum known{};       ///< h where it is; zero where q would be
    double carried_on = 0;  ///< T rho there
    Spectrum control{};     ///< g so far
    double expected = 0;    ///< F, as a radiance, weighed
  };
  struct Candidate {
    std::uint32_t path, light;
    Spectrum value;
  };
  static constexpr std::size_t numbers_per_vertex = 2 * PathEstimator::blocks_per_vertex;

  void draw(std::uint32_t block) {
    indices_.clear();
    for (const std::uint32_t k : live_) indices_.push_back(keys_.first + first_ + k);
    numbers_.resize(live_.size() * numbers_per_vertex);
    core::random_numbers(keys_.seed, keys_.stream, indices_, 2 * std::size_t{block}, numbers_per_vertex, numbers_);
  }
  PathEstimator::Numbers numbers(std::size_t j) const {
    const double* u = &numbers_[j * numbers_per_vertex];
    return {u[0], u[1], u[2], u[3], u[4], u[5], u[6]};
  }

  /// q, where T h is sent.
  double survival(const Path& path, const Spectrum& sent) const {
    if (path.expected == 0) return going_on(path.carried_on);
    return going_on(share_that_goes_on * std::max(path.carried_on, on_.scene().weigh(sent) / path.expected));
  }
  /// Whether a path goes on from where the solution knows something; what it says stands in for the rest.
  bool survives(Path& path, double u) const {
    Spectrum sent = path.carried.throughput * path.known;
    path.control -= sent;
    const double q = survival(path, sent);
    if (!(u < q)) return false;
    path.carried.throughput /= q;
    path.control += sent / q;
    return true;
  }
  /// Of the paths that live those of which this is true, asked of each place in turn.
  template <class Lives>
  void keep_if(const Lives& lives) {
    std::size_t kept = 0;
    for (std::size_t j = 0; j < live_.size(); ++j)
      if (lives(j)) live_[kept++] = live_[j];
    live_.resize(kept);
  }
  /// Each that goes on picks a light, and a direction.
  void scatter() {
    segments_.clear();
    candidates_.clear();
    keep_if([&](std::size_t j) { return scatter(live_[j], numbers(j)); });
  }
  bool scatter(std::uint32_t k, const PathEstimator::Numbers& drawn) {
    Path& path = paths_[k];
    const bool known = !path.known.is_zero();
    if (known && !survives(path, drawn.survival)) return false;
    const Place place = PathEstimator::place_of(path.at);
    if (const auto light = on_.from_lights(path.at, path.carried, place, drawn.pick, drawn.on_u, drawn.on_v)) {
      segments_.push_back(light->segment);
      candidates_.push_back({k, light->of, path.carried.throughput * light->light});
    }
    return on_.goes_on(path.at, place, drawn, path.carried, path.drawn, known);
  }
  void light() {
    const bool only_blocks = on_.sight_.only_blocks();
    blocked_.resize(segments_.size());
    if (only_blocks) on_.sight_.caster().occluded(segments_, blocked_);
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      const auto& [k, of, value] = candidates_[c];
      if (!only_blocks)
        paths_[k].carried.found += on_.sight_.let_pass(segments_[c], of) * value;
      else if (blocked_[c] == 0)
        paths_[k].carried.found += value;
    }
  }
  void arrive() {
    rays_.clear();
    for (const std::uint32_t k : live_) rays_.push_back(paths_[k].drawn.ray);
    met_.resize(rays_.size());
    on_.sight_.caster().closest_each(rays_, met_);
    keep_if([&](std::size_t j) { return arrive(paths_[live_[j]], met_[j]); });
  }
  bool arrive(Path& path, const std::optional<scene::SurfacePoint>& met) const {
    if (!on_.arrive(path.drawn, met, path.carried, path.at)) return false;
    path.carried_on = carried_on(path);
    path.known = path.carried_on > 0 ? of_.solution_.at(*met).reflected * inv_pi : Spectrum::zero();
    return true;
  }
  /// The largest T rho where all of a Bsdf is diffuse, and has one f; else 0.
  static double carried_on(const Path& path) {
    const Bsdf& bsdf = *path.at.bsdf;
    if (bsdf.glossy() || bsdf.mirrors() || bsdf.lets_pass() || bsdf.transmits()) return 0;
    const Spectrum reflectance = bsdf.f(path.at.to_eye, path.at.to_eye) * pi;
    return (path.carried.throughput * reflectance).max() / path.carried.squeezed;
  }

  const ControlledPaths& of_;
  const PathEstimator& on_;
  PathEstimator::Keys keys_;
  std::size_t first_ = 0;
  std::vector<Path> paths_;
  std::vector<std::uint32_t> live_;
  std::vector<std::uint64_t> indices_;
  std::vector<double> numbers_;
  std::vector<raycast::Segment> segments_;
  std::vector<std::uint8_t> blocked_;
  std::vector<Candidate> candidates_;
  std::vector<raycast::Ray> rays_;
  std::vector<std::optional<scene::SurfacePoint>> met_;
};

double control_factor(const core::ControlVariate& pilot) { return std::clamp(pilot.factor(), 0.0, 1.5); }

ControlledPaths::ControlledPaths(const scene::Scene& scene, const raycast::RayCaster& caster,
                                 const measure::SurfaceSolution& solution, const measure::PathClasses& paths)
    : solution_(solution), paths_(scene, caster, paths) {}

void ControlledPaths::irradiance(std::span<const Receiver> at, const PathEstimator::Keys& keys, std::uint32_t block,
                                 double expected, std::span<Found> found) const {
  Wave wave(*this, keys, at.size());
  for (std::size_t first = 0; first < at.size(); first += Wave::most) {
    const std::size_t count = std::min(Wave::most, at.size() - first);
    wave.begin(first);
    for (std::size_t k = 0; k < count; ++k) wave.start(k, at[first + k], expected);
    wave.follow(block);
    for (std::size_t k = 0; k < count; ++k) found[first + k] = wave.found(k, pi);
  }
}

void ControlledPaths::radiance(std::span<const std::optional<raycast::Ray>> from_eye, const PathEstimator::Keys& keys,
                               std::uint32_t block, std::span<Found> found) const {
  Wave wave(*this, keys, from_eye.size());
  for (std::size_t first = 0; first < from_eye.size(); first += Wave::most) {
    const std::size_t count = std::min(Wave::most, from_eye.size() - first);
    wave.begin(first);
    wave.start(from_eye.subspan(first, count));
    wave.follow(block);
    for (std::size_t k = 0; k < count; ++k) found[first + k] = wave.found(k, 1);
  }
}

}  // namespace interflect::montecarlo
