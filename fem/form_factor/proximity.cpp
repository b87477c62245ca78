#include "fem/form_factor/proximity.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fem/form_factor/point_to_polygon.h"
#include "fem/quadrature.h"

namespace interflect::fem {

namespace {

constexpr auto most_views = ProximityError::most_views;
constexpr double far =
    10;  ///< radii of the seen element, beyond which one node is good enough for an estimate of an error
constexpr int least_resolution = 16;
// From calibration in random scenes: tests/fem/hemicube.cpp.
constexpr double of_curvature = 1.5, of_range = 0.3, of_unseen = 0.075;

/// The centre first, then the nodes.
struct Views {
  std::array<Vec3, most_views> at;
  std::size_t count = 1;
};

Views views_of(const ElementShape& shape, const Vec3& centre) {
  Views views;
  views.at[0] = centre;
  std::vector<SurfaceNode> nodes;
  append_nodes(shape.ring(), shape.corners == 3 ? triangle_rule(4) : quad_rule(2), nodes);
  for (const SurfaceNode& node : nodes) views.at[views.count++] = node.position;
  return views;
}

double factor(const Vec3& x, const Vec3& n, const ElementShape& seen) {
  if (seen.plane.distance(x) <= 0) return 0;
  if ((seen.centroid - x).squaredNorm() > far * far * seen.radius * seen.radius)
    return point_to_polygon_far(x, n, seen.centroid, seen.plane.normal, seen.area);
  return point_to_polygon(x, n, seen.ring());
}

/// For what no view sees: the highest factor from any point, where it is large against the distance; else what parallax
/// leaves of it.
double unseen_factor(const ElementShape& from, const Views& views, const Vec3& n, const ElementShape& seen) {
  double highest = 0;
  for (const Vec3& x : from.ring()) highest = std::max(highest, factor(x, n, seen));
  for (std::size_t k = 0; k < views.count; ++k) highest = std::max(highest, factor(views.at[k], n, seen));
  return highest * std::min(1.0, 2 * from.radius / (seen.centroid - from.centroid).norm());
}

bool hides_something(const SeenItems& seen) {
  const auto sum = [](const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); };
  return sum(seen.covered) > sum(seen.visible) + 1e-9;
}

/// Visible parts from each view; from a view that has no sample of the item, the mean of the others.
std::array<double, most_views> visible_parts(std::span<const SeenItems> seen, std::size_t item) {
  std::array<double, most_views> parts;
  double sum = 0, known = 0;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    parts[k] = seen[k].covered[item] > 0 ? std::min(1.0, seen[k].visible[item] / seen[k].covered[item]) : -1;
    if (parts[k] >= 0) sum += parts[k], ++known;
  }
  for (double& part : parts)
    if (part < 0) part = known > 0 ? sum / known : 1;
  return parts;
}

/// @param V  visible parts of the item from each view
ProximityError::Item estimated(const ElementShape& from, const Views& views, const Vec3& n, const ElementShape& seen,
                               const std::array<double, most_views>& V) {
  const double unoccluded = factor(views.at[0], n, seen), centre = unoccluded * V[0];
  double mean = 0, least = centre, most = centre;
  for (std::size_t k = 1; k < views.count; ++k) {
    const double g = factor(views.at[k], n, seen) * V[k];
    mean += g / static_cast<double>(views.count - 1);
    least = std::min(least, g);
    most = std::max(most, g);
  }
  if (most == 0) return {unoccluded, of_unseen * unseen_factor(from, views, n, seen)};
  return {unoccluded, of_curvature * std::abs(mean - centre) + of_range * (most - least) * (most - least) / most};
}

}  // namespace

ProximityError::ProximityError(const ViewScene& scene, int resolution)
    : scene_(scene), coarse_(HemicubeGrid::uniform(std::max(least_resolution, resolution / 8 * 2))) {}

void ProximityError::estimate(const Eye& centre, Index element, Workspace& workspace, std::vector<Item>& items) const {
  const Views views = views_of(scene_[element], centre.position);
  workspace.sight.look(scene_, centre, element, workspace.seen[0]);
  const bool shadows = hides_something(workspace.seen[0]);
  for (std::size_t k = 1; shadows && k < views.count; ++k)
    workspace.sight.look(scene_, {views.at[k], centre.frame}, element, workspace.seen[k]);

  std::array<double, most_views> V;
  V.fill(1);
  items.assign(static_cast<std::size_t>(scene_.elements()), {});
  for (std::size_t item = 0; item < items.size(); ++item) {
    const auto index = static_cast<Index>(item);
    if (index == element) continue;
    if (shadows) V = visible_parts(std::span(workspace.seen).first(views.count), item);
    items[item] = estimated(scene_[element], views, centre.frame.n, scene_[index], V);
  }
}

}  // namespace interflect::fem
