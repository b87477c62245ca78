#pragma once

#include <functional>
#include <vector>

#include "core/run.h"
#include "fem/form_factor/method.h"
#include "fem/form_factor/pair_integral.h"
#include "fem/radiosity.h"
#include "raycast/ray_caster.h"
#include "scene/builder.h"

/// Small scenes and elements for the tests of fem.
namespace interflect::fem::test {

inline scene::Material diffuse(double reflectance, double exitance = 0.0) {
  return {"", Spectrum(reflectance), Spectrum(exitance), scene::Sides::front};
}

/// n x n elements of a parallelogram: corner, then its sides; the front is along u x v.
inline void add_grid(std::vector<scene::SurfacePatch>& out, scene::SurfaceId surface, const Vec3& corner, const Vec3& u,
                     const Vec3& v, int n) {
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      const auto at = [&](int i, int j) -> Vec3 { return corner + u * (double(i) / n) + v * (double(j) / n); };
      const Vec3 ring[] = {at(a, b), at(a + 1, b), at(a + 1, b + 1), at(a, b + 1)};
      out.push_back(scene::make_patch(surface, scene::Side::front, ring));
    }
}

inline geometry::PlanarPolygon parallelogram(const Vec3& corner, const Vec3& u, const Vec3& v) {
  return {{corner, corner + u, corner + u + v, corner + v}, {}};
}

/// A scene and its elements, put together parallelogram by parallelogram.
class Room {
 public:
  explicit Room(std::vector<std::string> channels = {"y"})
      : builder_(std::move(channels), scene::Quantity::radiometric) {}

  scene::SurfaceId wall(const Vec3& corner, const Vec3& u, const Vec3& v, int n, double reflectance = 0.0,
                        double exitance = 0.0) {
    const auto material = builder_.add_material(diffuse(reflectance, exitance));
    const auto id = builder_.add_polygon("wall", parallelogram(corner, u, v), material);
    add_grid(patches, id, corner, u, v, n);
    return id;
  }
  scene::SurfaceId triangle(const Vec3& a, const Vec3& b, const Vec3& c, double reflectance = 0.0,
                            double exitance = 0.0) {
    const geometry::Ring ring{a, b, c};
    const auto id = builder_.add_polygon("triangle", {ring, {}}, builder_.add_material(diffuse(reflectance, exitance)));
    patches.push_back(scene::make_patch(id, scene::Side::front, ring));
    return id;
  }
  /// Both sides black to light, no elements: what only blocks.
  void screen(const Vec3& corner, const Vec3& u, const Vec3& v) {
    builder_.add_polygon("screen", parallelogram(corner, u, v), builder_.add_material(diffuse(0.0)));
  }
  /// The six walls of a box, n x n elements each, facing inwards or outwards.
  void box(const Vec3& low, const Vec3& size, int n, bool inwards = true, double reflectance = 0.0,
           double exitance = 0.0) {
    for (int axis = 0; axis < 3; ++axis)
      for (int high = 0; high < 2; ++high) {
        Vec3 u = Vec3::Zero(), v = Vec3::Zero(), corner = low;
        u[(axis + 1) % 3] = size[(axis + 1) % 3];
        v[(axis + 2) % 3] = size[(axis + 2) % 3];
        if (high == 1) corner[axis] += size[axis];
        if ((high == 1) == inwards) std::swap(u, v);
        wall(corner, u, v, n, reflectance, exitance);
      }
  }
  /// The same as six surfaces without elements (whole_surfaces), each corner moved.
  void solid(const geometry::Box& box, bool inwards, const std::function<Vec3(const Vec3&)>& place) {
    builder_.add_box("solid", box, builder_.add_material(diffuse(0.0)),
                     inwards ? scene::SceneBuilder::Facing::inward : scene::SceneBuilder::Facing::outward, place);
  }
  scene::Scene finish() { return builder_.finish(); }

  std::vector<scene::SurfacePatch> patches;

 private:
  scene::SceneBuilder builder_;
};

/// An element for each surface, which is a triangle or a convex quad.
inline std::vector<scene::SurfacePatch> whole_surfaces(const scene::Scene& scene) {
  std::vector<scene::SurfacePatch> patches;
  for (const scene::SurfaceId id : scene.surface_ids())
    patches.push_back(scene::make_patch(id, scene::Side::front, scene.surface(id).outline->outer));
  return patches;
}

/// Entries as they come.
class MatrixSink final : public ExchangeSink {
 public:
  explicit MatrixSink(std::size_t n) : K(Eigen::MatrixXd::Zero(Index(n), Index(n))), error(K) {}
  void add(Index a, Index b, const ExchangeEntry& entry) override {
    const double both = std::hypot(entry.standard_error, entry.bound);
    K(a, b) += entry.K;
    error(a, b) += both;
    if (a != b) K(b, a) += entry.K, error(b, a) += both;
  }
  Eigen::MatrixXd K, error;  ///< error: of sampling and quadrature
};

/// Entries as they came last.
class LastEntrySink final : public ExchangeSink {
 public:
  explicit LastEntrySink(std::size_t n) : K(Eigen::MatrixXd::Zero(Index(n), Index(n))) {}
  void add(Index a, Index b, const ExchangeEntry& entry) override { K(a, b) = K(b, a) = entry.K; }
  Eigen::MatrixXd K;
};

/// All pairs by "gauss-lambert".
struct Assembled {
  Eigen::MatrixXd K, error;
  PairCounts pairs;
};
inline Assembled form_factors(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches, double tolerance,
                              int rays = 16, std::uint64_t seed = 1) {
  const auto caster = raycast::make_ray_caster("brute", scene);
  const auto method = make_form_factor_method("gauss-lambert", {scene, patches, *caster, seed, tolerance, rays});
  MatrixSink sink(patches.size());
  core::LocalRun run(seed, 1);
  const ElementBlock all{patches, 0, static_cast<Index>(patches.size())};
  const PairCounts pairs = method->exchange(all, all, sink, run.get());
  return {sink.K, sink.error, pairs};
}

struct SolveOptions {
  double element_size = 0.25, tolerance = 1e-4;
  int rays = 16;
  bool closure = false;
  unsigned threads = 2;
  std::uint64_t seed = 1;
  std::string intersector = "brute";
};
inline RadiositySolution solve(const scene::Scene& scene, const SolveOptions& options) {
  RadiositySettings settings;
  settings.element_size = options.element_size;
  settings.quadrature_tolerance = options.tolerance;
  settings.visibility_rays = options.rays;
  if (options.closure) settings.closure = "scaling";
  settings.intersector = options.intersector;
  core::LocalRun run(options.seed, options.threads);
  return solve_radiosity(scene, settings, run.get());
}

/// Area mean over a surface's elements.
inline double mean_over(const RadiositySolution& s, std::span<const Spectrum> values, scene::SurfaceId surface,
                        int channel = 0) {
  double sum = 0, area = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (s.mesh.patches()[i].surface == surface) {
      sum += s.mesh.patches()[i].area * values[i][channel];
      area += s.mesh.patches()[i].area;
    }
  return sum / area;
}

/// sum_j F_ij of elements between which nothing lies.
inline std::vector<double> unoccluded_row_sums(const std::vector<scene::SurfacePatch>& patches, double tolerance) {
  const PairIntegrator integrate(patches, tolerance);
  std::vector<double> sum(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double K = integrate(Index(i), Index(j)).value;
      sum[i] += K / patches[i].area;
      sum[j] += K / patches[j].area;
    }
  return sum;
}

}  // namespace interflect::fem::test
