#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "mesh/bisection.h"
#include "mesh/narrow_places.h"
#include "mesh/quad_grid.h"
#include "mesh/uniform.h"

namespace interflect::mesh {
namespace {

// Measured on `triangulate_refined`: its triangles' mean area is this much of max_edge².
constexpr double refined_triangle_area = 0.205;

double predicted_on_front(const scene::Scene& scene, scene::SurfaceId id, double max_edge) {
  const scene::Surface& surface = scene.surface(id);
  if (const auto cells = quad_grid_cells(surface, max_edge)) return *cells;
  if (surface.outline && !has_needle(*surface.outline)) {
    const double each = refined_triangle_area * max_edge * max_edge;
    const double narrow = triangles_of_narrow_places(*surface.outline, each);
    // Where there is room; and what corners need at least, as many as facets, or narrow places.
    return scene.area(id) / each + std::max<double>(surface.facets, narrow);
  }
  double count = 0;
  for (const scene::Facet& facet : scene.facets_of(id)) count += bisected_count(facet, max_edge);
  return count;
}

/// Two significant digits.
double rounded(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
  return std::round(x / unit) * unit;
}

}  // namespace

double predicted_elements(const scene::Scene& scene, double max_edge, HasElements has_elements) {
  if (!(max_edge > 0)) throw core::PreconditionError("predicted_elements: the longest edge must be positive");
  double count = 0;
  for (const scene::SurfaceId id : scene.surface_ids())
    if (const int sides =
            has_elements(scene.material(id), scene::Side::front) + has_elements(scene.material(id), scene::Side::back);
        sides > 0)
      count += predicted_on_front(scene, id, max_edge) * sides;
  return count;
}

double edge_for_area(double area, double elements) {
  if (!(area > 0) || !(elements > 0)) throw core::PreconditionError("edge_for_area: positive numbers expected");
  return rounded(std::sqrt(area / (refined_triangle_area * elements)));
}

double meshed_area(const scene::Scene& scene, HasElements has_elements) {
  double area = 0;
  for (const scene::SurfaceId id : scene.surface_ids())
    for (const scene::Side side : {scene::Side::front, scene::Side::back})
      if (has_elements(scene.material(id), side)) area += scene.area(id);
  return area;
}

double edge_for(const scene::Scene& scene, double elements, HasElements has_elements) {
  if (!(elements > 0)) throw core::PreconditionError("edge_for: a positive number of elements expected");
  double high = scene.box().diagonal().norm(), low = high;
  if (!(high > 0)) throw core::PreconditionError("edge_for: the scene has no extent");
  while (predicted_elements(scene, low, has_elements) < elements) low *= 0.5;
  while (high / low > 1.005) {
    const double middle = std::sqrt(low * high);
    (predicted_elements(scene, middle, has_elements) < elements ? high : low) = middle;
  }
  return rounded(std::sqrt(low * high));
}

}  // namespace interflect::mesh
