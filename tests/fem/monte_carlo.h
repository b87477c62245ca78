#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "fem/assembly.h"
#include "tests/fem/rooms.h"

/// Form factors by sampling, asked for in tests.
namespace interflect::fem::test {

inline const std::vector<std::string> monte_carlo_methods{"area-to-area", "hemisphere-rays", "global-lines"};

/// A scene with its elements and its caster, which methods are made for.
class Sampled {
 public:
  explicit Sampled(Room room, const std::string& caster = "embree")
      : patches_(room.patches), scene_(room.finish()), rays_(raycast::make_ray_caster(caster, scene_)) {}
  Sampled(const Sampled&) = delete;
  Sampled& operator=(const Sampled&) = delete;

  FormFactorContext context(std::uint64_t samples, std::uint64_t seed = 1, double tolerance = 1e-3) const {
    return {
        .scene = scene_, .patches = patches_, .rays = *rays_, .seed = seed, .tolerance = tolerance, .samples = samples};
  }
  Assembled by(const std::string& name, std::uint64_t samples, std::uint64_t seed = 1, double tolerance = 1e-3,
               unsigned threads = 2) const {
    const auto method = make_form_factor_method(name, context(samples, seed, tolerance));
    MatrixSink sink(patches_.size());
    core::LocalRun run(seed, threads);
    const PairCounts pairs = assemble(*method, patches_, sink, run.get());
    return {sink.K, sink.error, pairs};
  }
  const std::vector<scene::SurfacePatch>& patches() const { return patches_; }
  double area(Index i) const { return patches_[static_cast<std::size_t>(i)].area; }

 private:
  std::vector<scene::SurfacePatch> patches_;
  scene::Scene scene_;
  std::unique_ptr<raycast::RayCaster> rays_;
};

/// Two unit squares at distance 1, face to face, in units of `scale`.
inline Room facing_squares(double scale = 1) {
  Room room;
  room.wall({0, 0, 0}, {scale, 0, 0}, {0, scale, 0}, 1);
  room.wall({0, 0, scale}, {0, scale, 0}, {scale, 0, 0}, 1);
  return room;
}
/// The same with a square screen of side 1/2 half way (docs/truths.md 2.11: V6 in the corner, V7 in the centre).
inline Room screened_squares(double screen_corner, double scale = 1) {
  Room room = facing_squares(scale);
  room.screen(scale * Vec3(screen_corner, screen_corner, .5), {.5 * scale, 0, 0}, {0, .5 * scale, 0});
  return room;
}
inline constexpr double facing_truth = 0.19982489569838738, edge_truth = 0.20004377607540315;
inline constexpr double corner_screen_truth = 0.149868671774, centre_screen_truth = 0.099506294599;

inline Room squares_with_common_edge(double scale = 1) {
  Room room;
  room.wall({0, 0, 0}, {scale, 0, 0}, {0, scale, 0}, 1);
  room.wall({0, 0, 0}, {0, scale, 0}, {0, 0, scale}, 1);
  return room;
}

/// 5 x 4 x 3 m with two boxes that float in it: not convex, closed.
inline Room room_with_boxes(int n) {
  Room room;
  room.box({0, 0, 0}, {5, 4, 3}, n);
  room.box({1, 1, .2}, {1, .8, 1.2}, 1, false);
  room.box({3, 2.2, .5}, {1, .8, 1.1}, 1, false);
  return room;
}

/// The quantile of chi-squared with `dof` degrees of freedom at `z` standard normal deviations [Wilson, Hilferty 1931].
inline double chi_squared_quantile(double dof, double z) {
  return dof * std::pow(1 - 2 / (9 * dof) + z * std::sqrt(2 / (9 * dof)), 3);
}

}  // namespace interflect::fem::test
