#include "scene/flattening.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace interflect::scene {
namespace {

/// Of a polygon's corners to its plane, over its diameter: below it all corners are as good as in it.
constexpr double flat = 1e-12;
constexpr int most_steps = 20;
/// Eigenvalues of normals' second moment that are smaller, beside the largest, are of planes taken for one.
constexpr double one_plane = 1e-2;

using geometry::LocalPlane;
using geometry::PlanarPolygon;

template <class F>
void for_corners(const PlanarPolygon& polygon, const F& f) {
  for (const Vec3& x : polygon.outer) f(x);
  for (const geometry::Ring& hole : polygon.holes)
    for (const Vec3& x : hole) f(x);
}

template <class Move>
PlanarPolygon moved(PlanarPolygon polygon, const Move& move) {
  for (Vec3& x : polygon.outer) x = move(x);
  for (geometry::Ring& hole : polygon.holes)
    for (Vec3& x : hole) x = move(x);
  return polygon;
}

/// Of what stays flat wherever its corners go.
bool is_triangle(const PlanarPolygon& polygon) { return polygon.outer.size() == 3 && polygon.holes.empty(); }
bool is_bent(const PlanarPolygon& polygon) {
  return !is_triangle(polygon) && geometry::relative_planarity_error(polygon) > flat;
}

/// The shortest step from x to planes; where they have no common point, to where the squares of the distances are
/// least.
Vec3 step_to(const std::vector<LocalPlane>& planes, const Vec3& x) {
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  Vec3 pull = Vec3::Zero(), step = Vec3::Zero();
  for (const LocalPlane& plane : planes) {
    moment += plane.normal * plane.normal.transpose();
    pull -= plane.distance(x) * plane.normal;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> of(moment);
  for (int k = 0; k < 3; ++k)
    if (of.eigenvalues()[k] > one_plane * of.eigenvalues()[2])
      step += of.eigenvectors().col(k).dot(pull) / of.eigenvalues()[k] * of.eigenvectors().col(k);
  return step;
}

class Flattening {
 public:
  explicit Flattening(Scene& scene) : scene_(scene) {}

  Flattened run() {
    std::set<std::size_t> bent;
    for (std::size_t s = 0; s < scene_.surfaces.size(); ++s)
      if (scene_.surfaces[s].outline && is_bent(*scene_.surfaces[s].outline)) bent.insert(s);
    done_.polygons = bent.size();
    if (bent.empty()) return done_;
    find_corners();
    for (int step = 0; step < most_steps && !bent.empty(); ++step) bent = move_corners_of(bent);
    for (std::size_t s = 0; s < scene_.surfaces.size(); ++s) move_surface(s, [&](const Vec3& x) { return now(x); });
    for (const std::size_t s : bent) {
      const LocalPlane plane = geometry::local_plane_of(scene_.surfaces[s].outline->outer);
      move_surface(s, [&](const Vec3& x) -> Vec3 { return x - plane.distance(x) * plane.normal; });
    }
    return done_;
  }

 private:
  using Place = std::array<double, 3>;
  struct Corner {
    Vec3 now;
    std::vector<std::size_t> around;  ///< surfaces with this corner, without triangles
  };

  static Place place_of(const Vec3& x) { return {x.x() + 0.0, x.y() + 0.0, x.z() + 0.0}; }  // no -0
  const PlanarPolygon& given(std::size_t s) const { return *scene_.surfaces[s].outline; }
  void find_corners() {
    for (std::size_t s = 0; s < scene_.surfaces.size(); ++s) {
      if (!scene_.surfaces[s].outline || is_triangle(given(s))) continue;
      for_corners(given(s), [&](const Vec3& x) {
        corners_.try_emplace(place_of(x), Corner{x, {}}).first->second.around.push_back(s);
      });
    }
  }
  Vec3 now(const Vec3& given) const {
    const auto found = corners_.find(place_of(given));
    return found == corners_.end() ? given : found->second.now;
  }
  PlanarPolygon now(std::size_t s) const {
    return moved(given(s), [&](const Vec3& x) { return now(x); });
  }

  /// All at the same time.  Returns which polygons around them are bent afterwards.
  std::set<std::size_t> move_corners_of(const std::set<std::size_t>& bent) {
    std::map<Corner*, Vec3> next;
    std::set<std::size_t> touched;
    for (const std::size_t s : bent)
      for_corners(given(s), [&](const Vec3& x) {
        Corner& corner = corners_.at(place_of(x));
        std::vector<LocalPlane> planes;
        for (const std::size_t t : corner.around) planes.push_back(geometry::local_plane_of(now(t).outer));
        next[&corner] = corner.now + step_to(planes, corner.now);
        touched.insert(corner.around.begin(), corner.around.end());
      });
    for (const auto& [corner, to] : next) corner->now = to;
    std::erase_if(touched, [&](std::size_t s) { return !is_bent(now(s)); });
    return touched;
  }

  template <class Move>
  void move_surface(std::size_t s, const Move& move) {
    Surface& surface = scene_.surfaces[s];
    const auto noted = [&](const Vec3& x) -> Vec3 {
      const Vec3 to = move(x);
      done_.furthest = std::max(done_.furthest, (to - x).norm());
      return to;
    };
    if (surface.outline) surface.outline = moved(*surface.outline, noted);
    for (Facet& facet : std::span(scene_.facets).subspan(surface.first_facet, surface.facets)) {
      for (Vec3& x : facet.corner) x = noted(x);
      const Facet fitted = make_facet(facet.surface, facet.corner);
      facet.area = fitted.area;
      // Not its own in a polygon: that of a sliver beside a corner in mid-edge would be noise.
      facet.normal = surface.outline ? geometry::plane_of(surface.outline->outer).normal : fitted.normal;
    }
  }

  Scene& scene_;
  std::map<Place, Corner> corners_;
  Flattened done_;
};

}  // namespace

Flattened flatten_polygons(Scene& scene) { return Flattening(scene).run(); }

}  // namespace interflect::scene
