#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/box_tree.h"
#include "geometry/overlap.h"
#include "scene/inspection_parts.h"

namespace interflect::scene {
namespace {

using Kind = Inspection::Finding::Kind;

/// What two surfaces have in common.
struct Shared {
  double area = 0, largest = 0, same_way = 0, twice = 0;
  double duplicated = 0;  ///< area of facets that are the same
  Vec3 where = Vec3::Zero();
};

Vec3 middle(const Facet& f) { return (f.corner[0] + f.corner[1] + f.corner[2]) / 3; }

double perimeter(const Facet& f) {
  return (f.corner[1] - f.corner[0]).norm() + (f.corner[2] - f.corner[1]).norm() + (f.corner[0] - f.corner[2]).norm();
}

bool is_two_sided(const Scene& scene, const Facet& f) { return scene.material(f.surface).active(Side::back); }

/// Area of b (the smaller) that lies on a; 0 where it is no more than a strip as wide as the tolerance.
double area_on(const Facet& a, const Facet& b, double tolerance) {
  for (const Vec3& x : b.corner)
    if (std::abs(a.normal.dot(x - a.corner[0])) > tolerance) return 0;
  if (std::abs(a.normal.dot(b.normal)) < 0.9) return 0;  // a needle across the plane
  const double shared = geometry::overlap_area(b.corner, a.corner);
  return shared > tolerance * perimeter(b) ? shared : 0;
}

}  // namespace

void find_coplanar_faces(const Scene& scene, double tolerance, Inspection& inspection) {
  std::vector<geometry::Box> boxes;
  for (const Facet& facet : scene.facets) {
    boxes.push_back(geometry::box_of(facet.corner));
    boxes.back().min().array() -= tolerance;
    boxes.back().max().array() += tolerance;
  }
  const geometry::BoxTree tree(boxes);
  std::map<std::pair<std::uint32_t, std::uint32_t>, Shared> shared;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    const auto visit = [&](std::uint32_t j) {
      if (j <= i || !boxes[i].intersects(boxes[j])) return;
      const Facet &f = scene.facets[i], &g = scene.facets[j];
      const bool f_larger = f.area >= g.area;
      const double area = f_larger ? area_on(f, g, tolerance) : area_on(g, f, tolerance);
      if (area <= 0) return;
      const auto pair = std::minmax({f.surface.value, g.surface.value});
      Shared& s = shared[{pair.first, pair.second}];
      s.area += area;
      const bool same_way = f.normal.dot(g.normal) > 0;
      if (same_way) s.same_way += area;
      if (same_way || is_two_sided(scene, f) || is_two_sided(scene, g)) s.twice += area;
      if (area >= (1 - 1e-6) * std::max(f.area, g.area)) s.duplicated += area;
      if (area > s.largest) s.largest = area, s.where = middle(f_larger ? g : f);
    };
    tree.traverse([&](const geometry::Box& box) { return box.intersects(boxes[i]); }, visit);
  }
  for (const auto& [pair, s] : shared) {
    const double larger = std::max(scene.area(SurfaceId{pair.first}), scene.area(SurfaceId{pair.second}));
    const bool duplicate =
        s.duplicated >= (1 - 1e-6) * s.area || (pair.first != pair.second && s.area >= (1 - 1e-6) * larger);
    inspection.findings.push_back(
        {duplicate ? Kind::duplicate_faces : Kind::coplanar_overlap, scene.surfaces[pair.first].name,
         pair.first == pair.second ? "" : scene.surfaces[pair.second].name, s.where, s.area, s.same_way, s.twice});
  }
}

std::vector<Inspection::Finding> overlaps(const Scene& scene) {
  constexpr double one_plane = 1e-9, coordinates = 0x1p-47;  // of the size; of the largest coordinate
  const geometry::Box box = scene.box();
  if (box.isEmpty()) return {};
  const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  Inspection found;
  find_coplanar_faces(scene, std::max(one_plane * box.diagonal().norm(), coordinates * largest), found);
  return found.findings;
}

}  // namespace interflect::scene
