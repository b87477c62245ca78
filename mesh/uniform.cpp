#include "mesh/uniform.h"

#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/format.h"
#include "mesh/bisection.h"
#include "mesh/narrow_places.h"
#include "mesh/quad_grid.h"

namespace interflect::mesh {
namespace {

constexpr double most_elements = 0x1p31;

using scene::Side;
using scene::SurfaceId;
using scene::SurfacePatch;

/// The front elements of one surface.
std::vector<SurfacePatch> grid_elements(SurfaceId id, const QuadGrid& grid) {
  std::vector<SurfacePatch> elements;
  elements.reserve(std::size_t{grid.nu} * grid.nv);
  for (std::uint32_t j = 0; j < grid.nv; ++j)
    for (std::uint32_t i = 0; i < grid.nu; ++i) {
      const std::array<Vec3, 4> ring{grid.point(i, j), grid.point(i + 1, j), grid.point(i + 1, j + 1),
                                     grid.point(i, j + 1)};
      elements.push_back(make_patch(id, Side::front, ring));
    }
  return elements;
}

std::vector<SurfacePatch> triangle_elements(SurfaceId id, const geometry::IndexedTriangles& mesh) {
  std::vector<SurfacePatch> elements;
  elements.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::array<Vec3, 3> ring{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
    elements.push_back(make_patch(id, Side::front, ring));
  }
  return elements;
}

/// Every element, and every quarter of it, must have an area for its coordinates: far from the origin those of a needle
/// round onto a line.
void require_resolved(const scene::Surface& surface, std::span<const SurfacePatch> elements) {
  for (const SurfacePatch& element : elements) {
    const Vec3 whole = geometry::vector_area(element.ring()), x = element.corner[0];
    for (const SurfacePatch& part : quarters_of(element))
      if (!(geometry::vector_area(part.ring()).dot(whole) > 0))
        throw core::InputError(
            "surface '" + surface.name + "'",
            core::format("too thin for its coordinates at (%.10g, %.10g, %.10g): an element cut into four has no area",
                         x.x(), x.y(), x.z()));
  }
}

std::vector<SurfacePatch> front_elements(const scene::Scene& scene, SurfaceId id, double max_edge) {
  const scene::Surface& surface = scene.surface(id);
  if (const auto grid = quad_grid(surface, max_edge)) return grid_elements(id, *grid);
  if (surface.outline && !has_needle(*surface.outline))
    return triangle_elements(id, geometry::triangulate_refined(*surface.outline, max_edge));
  return triangle_elements(id, bisected(scene.facets_of(id), max_edge));
}

/// As few elements as may be: a triangle and a convex quad are one, all else consists of its facets.
std::vector<SurfacePatch> whole_front(const scene::Scene& scene, SurfaceId id) {
  constexpr double no_limit = std::numeric_limits<double>::max();
  const scene::Surface& surface = scene.surface(id);
  if (const auto grid = quad_grid(surface, no_limit)) return grid_elements(id, *grid);
  if (surface.outline && surface.outline->outer.size() == 3 && surface.outline->holes.empty())
    return {make_patch(id, Side::front, surface.outline->outer)};
  std::vector<SurfacePatch> elements;
  for (const scene::Facet& facet : scene.facets_of(id))
    if (facet.area > 0)
      elements.push_back(make_patch(id, Side::front, facet.corner));  // none beside a corner in mid-edge
  return elements;
}

/// The same element seen from the other side: the first corner stays the first.
SurfacePatch turned(SurfacePatch patch) {
  patch.side = Side::back;
  std::swap(patch.corner[1], patch.corner[patch.corners - 1u]);
  return patch;
}

/// All sides that get elements, from what makes those of a front.
template <class Front>
ElementMesh both_sides(const scene::Scene& scene, HasElements has_elements, const Front& front_of) {
  std::vector<SurfacePatch> patches;
  for (const SurfaceId id : scene.surface_ids()) {
    const bool of_front = has_elements(scene.material(id), Side::front),
               of_back = has_elements(scene.material(id), Side::back);
    if (!of_front && !of_back) continue;
    const std::vector<SurfacePatch> front = front_of(id);
    require_resolved(scene.surface(id), front);
    if (of_front) patches.insert(patches.end(), front.begin(), front.end());
    if (of_back)
      for (const SurfacePatch& patch : front) patches.push_back(turned(patch));
  }
  return ElementMesh(std::move(patches));
}

void require_few_enough(const scene::Scene& scene, double max_edge, HasElements has_elements) {
  if (!(max_edge > 0) || !std::isfinite(max_edge))
    throw core::InputError("element size", core::format("a positive length expected, not %g m", max_edge));
  if (const double count = predicted_elements(scene, max_edge, has_elements); !(count <= most_elements))
    throw core::InputError("element size",
                           core::format("%g m makes %.1e elements, at most 2^31 expected", max_edge, count));
}

}  // namespace

ElementMesh whole_faces(const scene::Scene& scene) {
  return both_sides(scene, is_active, [&](SurfaceId id) { return whole_front(scene, id); });
}

ElementMesh uniform(const scene::Scene& scene, double max_edge, HasElements has_elements) {
  require_few_enough(scene, max_edge, has_elements);
  return both_sides(scene, has_elements, [&](SurfaceId id) { return front_elements(scene, id, max_edge); });
}

ElementMesh coarse(const scene::Scene& scene, double max_edge) {
  require_few_enough(scene, max_edge, is_active);
  ElementMesh mesh = whole_faces(scene);
  while (mesh.longest_edge() > max_edge) {
    std::vector<bool> too_long;
    for (const SurfacePatch& patch : mesh.patches()) too_long.push_back(longest_edge(patch) > max_edge);
    mesh = quartered(mesh, too_long).mesh;
  }
  return mesh;
}

ElementMesh quartered(const ElementMesh& mesh) {
  return quartered(mesh, std::vector<bool>(mesh.patches().size(), true)).mesh;
}

PartlyQuartered quartered(const ElementMesh& mesh, const std::vector<bool>& which) {
  std::vector<SurfacePatch> patches;
  std::vector<std::size_t> parent;
  const auto append = [&](const SurfacePatch& patch, std::size_t of) {
    patches.push_back(patch);
    parent.push_back(of);
  };
  for (std::size_t i = 0; i < mesh.patches().size(); ++i) {
    const SurfacePatch& patch = mesh.patches()[i];
    if (!which[i]) append(patch, i);
    if (which[i])
      for (const SurfacePatch& part : quarters_of(patch)) append(part, i);
  }
  return {ElementMesh(std::move(patches)), std::move(parent)};
}

}  // namespace interflect::mesh
