#include "fem/environment_column.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "fem/element_rays.h"

namespace interflect::fem {
namespace {

/// Cells along each of the four dimensions.
std::uint64_t cells_along(std::uint64_t rays) {
  std::uint64_t k = 2;
  while (k * k * k * k < rays) k += 2;
  return k;
}

constexpr double unseen = 2;  // rays

struct Column {
  double factor, standard_error;
};

/// The sides of surfaces that have elements.
class Receivers {
 public:
  Receivers(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches) : has_(2 * scene.surfaces.size()) {
    for (const scene::SurfacePatch& patch : patches) has_[at(patch.surface, patch.side)] = 1;
  }
  bool misses(const std::optional<scene::SurfacePoint>& hit) const {
    return !hit || !has_[at(hit->surface, hit->side)];
  }

 private:
  static std::size_t at(scene::SurfaceId surface, scene::Side side) {
    return 2 * std::size_t{surface.value} + (side == scene::Side::back);
  }
  std::vector<std::uint8_t> has_;
};

/// Cells in pairs that differ in the elevation alone.
Column column_of(const Receivers& receivers, const scene::SurfacePatch& patch, const raycast::RayCaster& rays,
                 std::uint64_t k, std::uint64_t seed, std::uint32_t element) {
  const ElementRays from(patch);
  const auto cells = static_cast<double>(k), n = cells * cells * cells * cells;
  double sum = 0, squares = 0, before = 0;
  for (std::uint64_t j = 0; j < k * k * k * k; ++j) {
    core::RandomNumbers random(seed, element, j);
    const auto in_cell = [&](std::uint64_t cell) { return (static_cast<double>(cell % k) + random.next()) / cells; };
    const double u = in_cell(j), v = in_cell(j / k), s = in_cell(j / (k * k)), t = in_cell(j / (k * k * k));
    const ElementRay ray = from(s, t, u, v);
    const double x = receivers.misses(rays.closest(ray.ray)) ? ray.weight : 0.0;
    sum += x;
    if (j % 2 == 1) squares += (x - before) * (x - before);
    before = x;
  }
  return {std::clamp(sum / n, 0.0, 1.0), std::sqrt(squares + unseen * unseen) / n};
}

}  // namespace

EnvironmentColumn cast_environment_column(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                                          const raycast::RayCaster& rays, std::uint64_t rays_an_element, Run& run) {
  const std::uint64_t k = cells_along(rays_an_element), seed = core::derived_seed(run.seed, "environment column");
  const Receivers receivers(scene, patches);
  EnvironmentColumn column{std::vector<double>(patches.size()), std::vector<double>(patches.size())};
  core::Progress::Stage stage(run.progress, "environment column", patches.size());
  run.threads.for_blocks(static_cast<Index>(patches.size()), 16, [&](Index begin, Index end) {
    run.throw_if_stopped("environment column");
    for (auto a = static_cast<std::size_t>(begin); a < static_cast<std::size_t>(end); ++a) {
      const Column c = column_of(receivers, patches[a], rays, k, seed, static_cast<std::uint32_t>(a));
      column.factor[a] = c.factor;
      column.standard_error[a] = c.standard_error;
    }
    stage.advance(static_cast<std::uint64_t>(end - begin));
  });
  return column;
}

bool is_closed(const EnvironmentColumn& column) {
  return std::all_of(column.factor.begin(), column.factor.end(), [](double factor) { return factor == 0; });
}

}  // namespace interflect::fem
