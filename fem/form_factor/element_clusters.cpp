#include "fem/form_factor/element_clusters.h"

#include <algorithm>
#include <cmath>

namespace interflect::fem {

namespace {

using Elements = std::vector<Index>;
constexpr std::size_t fewest_in_a_plane = 8;

bool same_plane(const ElementShapes& shapes, const ElementShape& a, const ElementShape& b) {
  if (a.plane.normal.dot(b.plane.normal) < 0.99) return false;
  for (const Vec3& p : b.ring())
    if (std::abs(a.plane.distance(p)) > shapes.height_tolerance(a, p)) return false;
  return true;
}

/// Groups by plane; elements whose plane few share come last, as one group.
std::vector<Elements> by_plane(const Elements& elements, const ElementShapes& shapes) {
  std::vector<Elements> planes;
  Elements rest;
  std::vector<Elements> open;
  std::size_t searched = 0;
  for (const Index e : elements) {
    // Neighbours in the list are mostly neighbours in space: the latest planes are tried, not all of a curved
    // surface's.
    searched = open.size() > 16 ? open.size() - 16 : 0;
    auto found = std::find_if(open.begin() + static_cast<Index>(searched), open.end(), [&](const Elements& plane) {
      return same_plane(shapes, shapes[plane.front()], shapes[e]);
    });
    if (found == open.end()) found = open.insert(open.end(), Elements{});
    found->push_back(e);
  }
  for (Elements& plane : open)
    if (plane.size() >= fewest_in_a_plane)
      planes.push_back(std::move(plane));
    else
      rest.insert(rest.end(), plane.begin(), plane.end());
  if (!rest.empty()) planes.push_back(std::move(rest));
  return planes;
}

/// The rectangle along the first element's first edge that holds the elements, if they share a plane.
std::optional<std::array<Vec3, 4>> rectangle_of(const Elements& elements, const ElementShapes& shapes) {
  const ElementShape& first = shapes[elements.front()];
  const Vec3 normal = first.plane.normal, along = (first.corner[1] - first.corner[0]).normalized();
  const Vec3 across = normal.cross(along), origin = first.corner[0];
  Eigen::AlignedBox2d box;
  for (const Index e : elements) {
    if (!same_plane(shapes, first, shapes[e])) return std::nullopt;
    for (const Vec3& p : shapes[e].ring()) box.extend(Vec2(along.dot(p - origin), across.dot(p - origin)));
  }
  const auto at = [&](double u, double v) -> Vec3 { return origin + u * along + v * across; };
  const Vec2 low = box.min(), high = box.max();
  return std::array<Vec3, 4>{at(low.x(), low.y()), at(high.x(), low.y()), at(high.x(), high.y()),
                             at(low.x(), high.y())};
}

void split(Elements elements, const ElementShapes& shapes, std::size_t largest, std::vector<ElementCluster>& out) {
  if (elements.size() <= largest) {
    std::sort(elements.begin(), elements.end());
    auto rectangle = rectangle_of(elements, shapes);
    out.push_back({std::move(elements), rectangle});
    return;
  }
  Eigen::AlignedBox3d box;
  for (const Index e : elements) box.extend(shapes[e].centroid);
  Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto middle = elements.begin() + static_cast<Index>(elements.size() / 2);
  std::nth_element(elements.begin(), middle, elements.end(), [&](Index a, Index b) {
    const double p = shapes[a].centroid[axis], q = shapes[b].centroid[axis];
    return p < q || (p == q && a < b);
  });
  split(Elements(elements.begin(), middle), shapes, largest, out);
  split(Elements(middle, elements.end()), shapes, largest, out);
}

}  // namespace

std::vector<ElementCluster> clusters_of(std::span<const scene::SurfacePatch> patches, const ElementShapes& shapes,
                                        std::size_t largest) {
  std::vector<ElementCluster> clusters;
  for (std::size_t first = 0; first < patches.size();) {
    std::size_t end = first;
    Elements part;
    while (end < patches.size() && patches[end].surface == patches[first].surface &&
           patches[end].side == patches[first].side)
      part.push_back(static_cast<Index>(end++));
    for (const Elements& plane : by_plane(part, shapes)) split(plane, shapes, largest, clusters);
    first = end;
  }
  return clusters;
}

}  // namespace interflect::fem
