#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "measure/measurement.h"
#include "montecarlo/film/spread.h"
#include "scene/film_map.h"
#include "scene/scene.h"

namespace interflect::montecarlo {

/// Measurements that a path from a light cannot hit, and is joined with: points and pixels.
class SplatTargets {
 public:
  /// @pre  require_measurable of all.  The scene must outlive it.
  SplatTargets(const scene::Scene& scene, std::span<const measure::Measurement> asked);
  /// All pixels of a picture: measurement y * width + x is what the filter makes of the film there.  Both must outlive it.
  SplatTargets(const scene::Camera& camera, const ReconstructionFilter& filter);

  struct Point {
    std::uint32_t measurement;
    Vec3 position, normal;
  };
  /// A camera, and which measurement each of its pixels is, `none` of those not asked for.
  struct Film {
    scene::FilmMap map;
    int width, height;
    std::vector<std::uint32_t> measurement;
    const ReconstructionFilter& filter;
    static constexpr std::uint32_t none = ~0u;
    /// visit(measurement, how much of it) of all that count a point of the film.
    template <class Visit>
    void visit(const Vec2& film, const Visit& visit) const {
      spread(film, width, height, filter, [&](int x, int y, double h) {
        const std::uint32_t m = measurement[static_cast<std::size_t>(y * width + x)];
        if (m != none) visit(m, h);
      });
    }
    bool counts(const Vec2& film) const {
      bool any = false;
      visit(film, [&](std::uint32_t, double) { any = true; });
      return any;
    }
  };
  std::span<const Point> points() const { return points_; }
  std::span<const Film> films() const { return films_; }
  bool empty() const { return points_.empty() && films_.empty(); }
  /// Pixels that were asked for before: a measurement, and which one it is.
  std::span<const std::pair<std::uint32_t, std::uint32_t>> again() const { return again_; }

 private:
  std::vector<Point> points_;
  std::vector<Film> films_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> again_;
};

}  // namespace interflect::montecarlo
