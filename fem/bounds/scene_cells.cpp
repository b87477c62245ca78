#include "fem/bounds/scene_cells.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "raycast/scene_frame.h"

namespace interflect::fem {

std::optional<SceneCells> scene_cells(const scene::Scene& scene) {
  constexpr double same_place = 1e-9;
  constexpr double coordinates = 4;  // roundings of coordinates, as near as which counts as the same place too
  constexpr std::size_t most_a_facet = 64, few = 100'000;
  const raycast::SceneFrame frame = raycast::frame_of(scene);
  SceneCells of{frame.centre, frame.size, 0, frame.rounding / frame.size, {}, {}, {}};
  of.tolerance = std::max(same_place, coordinates * of.rounding);
  for (const scene::Facet& facet : scene.facets) {
    std::array<Vec3, 3>& unit = of.facets.emplace_back(facet.corner);
    for (Vec3& x : unit) x = of.inside(x);
  }
  auto cells = facet_cells(of.facets, of.tolerance, few + most_a_facet * of.facets.size());
  if (!cells) return std::nullopt;
  of.cells = std::move(*cells);
  std::vector<geometry::Box> boxes;
  for (const FacetCell& cell : of.cells) boxes.push_back(geometry::box_of(cell.ring));
  of.tree = geometry::BoxTree(boxes);
  return of;
}

Vec3 middle_of(const FacetCell& cell) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& x : cell.ring) sum += x;
  return sum / static_cast<double>(cell.ring.size());
}

double depth_in(std::span<const Vec3> ring, const Vec3& normal, const Vec3& x) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec3& corner = ring[k];
    const Vec3 inward = normal.cross(ring[(k + 1) % ring.size()] - corner).normalized();
    least = std::min(least, inward.dot(x - corner));
  }
  return least;
}

bool are_parallel(const Vec3& normal, const Vec3& other) {
  constexpr double parallel = 1e-5;  // rad
  return normal.cross(other).norm() <= parallel;
}

}  // namespace interflect::fem
