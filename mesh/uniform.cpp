#include "mesh/uniform.h"

#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "mesh/bisection.h"
#include "mesh/quad_grid.h"

namespace interflect::mesh {
namespace {

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

std::vector<SurfacePatch> front_elements(const scene::Scene& scene, SurfaceId id, double max_edge) {
  const scene::Surface& surface = scene.surface(id);
  if (const auto grid = quad_grid(surface, max_edge)) return grid_elements(id, *grid);
  if (surface.outline) return triangle_elements(id, geometry::triangulate_refined(*surface.outline, max_edge));
  return triangle_elements(id, bisected(scene.facets_of(id), max_edge));
}

/// The same element seen from the other side: the first corner stays the first.
SurfacePatch turned(SurfacePatch patch) {
  patch.side = Side::back;
  std::swap(patch.corner[1], patch.corner[patch.corners - 1u]);
  return patch;
}

/// The four parts of an element, part k < 3 (k < 4 of a quad) holding its corner k.
std::array<SurfacePatch, 4> quarters(const SurfacePatch& p) {
  const auto part = [&](std::initializer_list<Vec3> ring) {
    return make_patch(p.surface, p.side, std::span(ring.begin(), ring.size()));
  };
  const auto& c = p.corner;
  const auto middle = [&](std::size_t i, std::size_t j) -> Vec3 { return 0.5 * (c[i] + c[j]); };
  const Vec3 m01 = middle(0, 1), m12 = middle(1, 2);
  if (p.corners == 3) {
    const Vec3 m20 = middle(2, 0);
    return {part({c[0], m01, m20}), part({m01, c[1], m12}), part({m20, m12, c[2]}), part({m12, m20, m01})};
  }
  const Vec3 m23 = middle(2, 3), m30 = middle(3, 0), centre = 0.5 * (m01 + m23);
  return {part({c[0], m01, centre, m30}), part({m01, c[1], m12, centre}), part({centre, m12, c[2], m23}),
          part({m30, centre, m23, c[3]})};
}

}  // namespace

ElementMesh uniform(const scene::Scene& scene, double max_edge) {
  if (!(max_edge > 0) || !std::isfinite(max_edge))
    throw core::InputError("element size", core::format("a positive length expected, not %g m", max_edge));
  std::vector<SurfacePatch> patches;
  for (const SurfaceId id : scene.surface_ids()) {
    const std::vector<SurfacePatch> front = front_elements(scene, id, max_edge);
    patches.insert(patches.end(), front.begin(), front.end());
    if (scene.material(id).active(Side::back))
      for (const SurfacePatch& patch : front) patches.push_back(turned(patch));
  }
  return ElementMesh(std::move(patches));
}

ElementMesh quartered(const ElementMesh& mesh) {
  std::vector<SurfacePatch> patches;
  patches.reserve(4 * mesh.patches().size());
  for (const SurfacePatch& patch : mesh.patches())
    for (const SurfacePatch& part : quarters(patch)) patches.push_back(part);
  return ElementMesh(std::move(patches));
}

}  // namespace interflect::mesh
