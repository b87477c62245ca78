#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "measure/measurement.h"
#include "scene/film_map.h"
#include "scene/scene.h"

namespace interflect::montecarlo {

/// Measurements that a path from a light cannot hit, and is joined with: points and pixels.
class SplatTargets {
 public:
  /// @pre  require_measurable of all.  The scene must outlive it.
  SplatTargets(const scene::Scene& scene, std::span<const measure::Measurement> asked);

  struct Point {
    std::uint32_t measurement;
    Vec3 position, normal;
  };
  /// A camera, and which measurement each of its pixels is, `none` of those not asked for.
  struct Film {
    scene::FilmMap map;
    int width, height;
    std::vector<std::uint32_t> measurement;
    static constexpr std::uint32_t none = ~0u;
    std::uint32_t at(const Vec2& film) const;
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
