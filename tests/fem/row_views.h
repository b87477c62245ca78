#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "core/random.h"
#include "fem/assembly.h"
#include "tests/fem/rooms.h"

/// What row methods write, view by view.
namespace interflect::fem::test {

/// K(a, b) as seen from a.
class ViewSink final : public ExchangeSink {
 public:
  explicit ViewSink(std::size_t n) : K(Eigen::MatrixXd::Zero(Index(n), Index(n))), bound(K) {}
  void add(Index a, Index b, const ExchangeEntry& entry) override {
    K(a, b) = entry.K;
    bound(a, b) = entry.bound;
  }
  Eigen::MatrixXd K, bound;
};

struct Views {
  Eigen::MatrixXd K, bound;
  PairCounts counts;
};
inline Views views(const FormFactorMethod& method, std::span<const scene::SurfacePatch> patches) {
  ViewSink sink(patches.size());
  core::LocalRun run(1, 1);
  const ElementBlock all{patches, 0, static_cast<Index>(patches.size())};
  const PairCounts counts = method.exchange(all, all, sink, run.get());
  return {sink.K, sink.bound, counts};
}
inline Views views(const std::string& name, const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                   int resolution, std::uint64_t seed = 1) {
  const auto caster = raycast::make_ray_caster("brute", scene);
  FormFactorContext context{scene, patches, *caster, seed};
  context.resolution = resolution;
  return views(*make_form_factor_method(name, context), patches);
}

/// A room of 5 x 4 x 3 m with two floating bodies; n x n elements a wall, m x m a body's face.
inline Room room_with_bodies(int n, int m) {
  Room room;
  room.box({0, 0, 0}, {5, 4, 3}, n);
  room.box({1, 1, .2}, {1, .8, 1.2}, m, false);
  room.box({3, 2.2, .5}, {1, .8, 1.1}, m, false);
  return room;
}

/// Ten triangles anywhere in a cube of side 2, with corners within `size` of their middles along each axis; great ones
/// cross.
inline Room ten_triangles(std::uint32_t stream, double size) {
  core::RandomNumbers u(77, stream, 0);
  const auto vector = [&u] {
    const double x = u.next(), y = u.next(), z = u.next();
    return Vec3(2 * x - 1, 2 * y - 1, 2 * z - 1);
  };
  Room room;
  for (int k = 0; k < 10; ++k) {
    const Vec3 centre = vector(), a = centre + size * vector(), b = centre + size * vector(),
               c = centre + size * vector();
    room.triangle(a, b, c);
  }
  return room;
}

/// Pairs whose true error is below the stated bound, of all that exchange anything or are said to.
struct Coverage {
  int pairs = 0, held = 0;
  std::vector<double> stated_over_true;
  double part() const { return double(held) / pairs; }
  double median() {
    const auto middle = stated_over_true.begin() + static_cast<Index>(stated_over_true.size() / 2);
    std::nth_element(stated_over_true.begin(), middle, stated_over_true.end());
    return *middle;
  }
  void add(double K, double bound, double exact, double rounding) {
    if (exact < 1e-12 && K == 0 && bound == 0) return;
    const double error = std::abs(K - exact);
    ++pairs;
    held += error <= bound + rounding;
    if (error > rounding) stated_over_true.push_back(bound / error);
  }
};

/// A scene and its form factors by "analytic".
struct SolvedScene {
  explicit SolvedScene(Room room) : scene(room.finish()), patches(std::move(room.patches)), exact(patches.size()) {
    const auto caster = raycast::make_ray_caster("brute", scene);
    const ElementBlock all{patches, 0, static_cast<Index>(patches.size())};
    core::LocalRun run(1, 1);
    make_form_factor_method("analytic", {scene, patches, *caster, 1, 1e-4})->exchange(all, all, exact, run.get());
  }
  scene::Scene scene;
  std::vector<scene::SurfacePatch> patches;
  MatrixSink exact;
};

/// Scenes that hide much, little, and something large.
struct SolvedScenes {
  SolvedScenes() {
    for (std::uint32_t k = 0; k < 15; ++k) {
      of["great triangles"].emplace_back(ten_triangles(k, 0.8));
      of["small triangles"].emplace_back(ten_triangles(100 + k, 0.3));
    }
    of["room"].emplace_back(room_with_bodies(3, 2));
  }
  std::map<std::string, std::vector<SolvedScene>> of;
};

/// Of a method's views, and of its joined views.
struct SceneCoverage {
  Coverage views, joined;
};
inline SceneCoverage coverage(const std::vector<SolvedScene>& scenes, const std::string& name, int resolution) {
  SceneCoverage found;
  for (const SolvedScene& solved : scenes) {
    const auto caster = raycast::make_ray_caster("brute", solved.scene);
    FormFactorContext context{solved.scene, solved.patches, *caster};
    context.resolution = resolution;
    const auto method = make_form_factor_method(name, context);
    const Views seen = test::views(*method, solved.patches);
    MatrixSink joined(solved.patches.size());
    core::LocalRun run(1, 1);
    assemble(*method, solved.patches, joined, run.get());
    for (Index a = 0; a < seen.K.rows(); ++a)
      for (Index b = 0; b < seen.K.rows(); ++b) {
        if (a == b) continue;
        const double exact = solved.exact.K(a, b), rounding = 1e-12 + solved.exact.error(a, b);
        found.views.add(seen.K(a, b), seen.bound(a, b), exact, rounding);
        if (a < b)
          found.joined.add(joined.K(a, b), joined.error(a, b), exact,
                           rounding + 1e-7 * exact);  // views are kept as floats
      }
  }
  return found;
}

}  // namespace interflect::fem::test
