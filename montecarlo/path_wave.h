#pragma once

#include <algorithm>
#include <vector>

#include "montecarlo/path_estimator.h"

namespace interflect::montecarlo {

/// What may go with paths, vertex by vertex.  This one does nothing.
struct Unaccompanied {
  /// What it knows of a path, anew when the path begins.
  struct Of {};
  /// Before a path scatters; `lost` ends it, and who `won` does not play the vertex's roulette.
  enum class Roulette : std::uint8_t { not_played, lost, won };
  template <class Carried>
  Roulette play(Of&, Carried&, double /*survival*/) const {
    return Roulette::not_played;
  }
  /// A path is at a vertex, by a ray that met this.
  template <class Vertex, class Carried>
  void arrived(Of&, const Vertex&, const Carried&, const scene::SurfacePoint&) const {}
};

/// Many paths of a PathEstimator, vertex by vertex together: their rays go to the ray caster eight by eight, their numbers
/// are drawn together.  Each is the path that it would be alone.
/// @tparam Company  as Unaccompanied
template <class Company>
class PathEstimator::Wave {
 public:
  /// So many that what they are stays in the nearest cache, and packets are full but at the end.
  static constexpr std::size_t most = 64;

  Wave(const PathEstimator& of, const Keys& keys, std::size_t count, const Company& company = {})
      : of_(of), company_(company), keys_(keys), paths_(std::min(most, count)) {
    const std::size_t n = paths_.size();  // once: memory that grows would take a twentieth of the time
    live_.reserve(n), indices_.reserve(n), numbers_.reserve(n * numbers_per_vertex);
    segments_.reserve(n), blocked_.reserve(n), candidates_.reserve(n), rays_.reserve(n), met_.reserve(n);
  }

  /// Of samples keys.first + first on.
  void begin(std::size_t first, std::size_t count) {
    first_ = first;
    live_.clear();
    const Carried nothing = of_.from_eye();
    for (std::size_t k = 0; k < count; ++k) paths_[k].carried = nothing, paths_[k].of = {};
  }

  /// Path k is at a vertex.
  void start(std::size_t k, const Vertex& at) {
    paths_[k].at = at;
    live_.push_back(static_cast<std::uint32_t>(k));
  }
  /// All are rays from the eye.
  void start(std::span<const std::optional<raycast::Ray>> from_eye) {
    for (std::size_t k = 0; k < from_eye.size(); ++k) {
      if (!from_eye[k]) continue;
      paths_[k].drawn = {*from_eye[k], {from_eye[k]->origin, Vec3::Zero()}, 0};
      live_.push_back(static_cast<std::uint32_t>(k));
    }
    arrive();
  }
  void follow(std::uint32_t block) {
    for (; !live_.empty(); block += blocks_per_vertex) {
      draw(block);
      scatter();
      light();
      arrive();
    }
  }
  const Spectrum& found(std::size_t k) const { return paths_[k].carried.found; }
  auto& of(std::size_t k) { return paths_[k].of; }
  /// The paths that go on.
  const std::vector<std::uint32_t>& live() const { return live_; }

 private:
  struct Path {
    Vertex at{};
    Carried carried{};
    Drawn drawn{{}, {}, 0};
    [[no_unique_address]] typename Company::Of of{};
  };
  using Roulette = Unaccompanied::Roulette;
  static constexpr std::size_t numbers_per_vertex = 2 * blocks_per_vertex;

  void draw(std::uint32_t block) {
    const std::size_t at = 2 * std::size_t{block},
                      given = std::clamp(keys_.given_each, at, at + numbers_per_vertex) - at;
    numbers_.resize(live_.size() * numbers_per_vertex);
    if (given < numbers_per_vertex) {
      indices_.clear();
      for (const std::uint32_t k : live_) indices_.push_back(keys_.first + first_ + k);
      core::random_numbers(keys_.seed, keys_.stream, indices_, at, numbers_per_vertex, numbers_);
    }
    if (given == 0) return;
    for (std::size_t j = 0; j < live_.size(); ++j)
      std::copy_n(&keys_.given_to(first_ + live_[j])[at], given, &numbers_[j * numbers_per_vertex]);
  }
  Numbers numbers(std::size_t j) const {
    const double* u = &numbers_[j * numbers_per_vertex];
    return {u[0], u[1], u[2], u[3], u[4], u[5], u[6]};
  }

  /// Each picks a light, and a direction to go on in, or ends.
  void scatter() {
    segments_.clear();
    candidates_.clear();
    std::size_t kept = 0;
    for (std::size_t j = 0; j < live_.size(); ++j) {
      const std::uint32_t k = live_[j];
      Path& path = paths_[k];
      const Numbers drawn = numbers(j);
      const Roulette played = company_.play(path.of, path.carried, drawn.survival);
      if (played == Roulette::lost) continue;
      const Place place = place_of(path.at);
      if (const auto light = of_.from_lights(path.at, path.carried, place, drawn.pick, drawn.on_u, drawn.on_v)) {
        segments_.push_back(light->segment);
        candidates_.push_back({k, light->of, path.carried.throughput, light->light});
      }
      if (of_.goes_on(path.at, place, drawn, path.carried, path.drawn, played == Roulette::won)) live_[kept++] = k;
    }
    live_.resize(kept);
  }
  struct Found {
    std::uint32_t path, light;
    Spectrum throughput, value;
  };

  /// What nothing hides of that.
  void light() {
    if (!of_.sight_.only_blocks()) {
      for (std::size_t c = 0; c < candidates_.size(); ++c)
        add(candidates_[c], of_.sight_.let_pass(segments_[c], candidates_[c].light) * candidates_[c].value);
      return;
    }
    blocked_.resize(segments_.size());
    of_.sight_.caster().occluded(segments_, blocked_);
    for (std::size_t c = 0; c < candidates_.size(); ++c)
      if (blocked_[c] == 0) add(candidates_[c], candidates_[c].value);
  }
  void add(const Found& candidate, const Spectrum& value) {
    paths_[candidate.path].carried.found += candidate.throughput * value;
  }

  void arrive() {
    rays_.clear();
    for (const std::uint32_t k : live_) rays_.push_back(paths_[k].drawn.ray);
    met_.resize(rays_.size());
    of_.sight_.caster().closest_each(rays_, met_);
    std::size_t kept = 0;
    for (std::size_t j = 0; j < live_.size(); ++j) {
      Path& path = paths_[live_[j]];
      if (!of_.arrive(path.drawn, met_[j], path.carried, path.at)) continue;
      company_.arrived(path.of, path.at, path.carried, *met_[j]);
      live_[kept++] = live_[j];
    }
    live_.resize(kept);
  }

  const PathEstimator& of_;
  Company company_;
  Keys keys_;
  std::size_t first_ = 0;
  std::vector<Path> paths_;
  std::vector<std::uint32_t> live_;
  std::vector<std::uint64_t> indices_;
  std::vector<double> numbers_;
  std::vector<raycast::Segment> segments_;
  std::vector<std::uint8_t> blocked_;
  std::vector<Found> candidates_;
  std::vector<raycast::Ray> rays_;
  std::vector<std::optional<scene::SurfacePoint>> met_;
};

}  // namespace interflect::montecarlo
