#include "fem/gather.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "fem/element_point.h"
#include "fem/form_factor/point_to_polygon.h"
#include "fem/form_factor/visibility.h"

namespace interflect::fem {

namespace {

constexpr int deepest_part = 4;         // 4^4 parts of one element at most
constexpr int most_rays_per_side = 64;  // of a part: 4 096 rays
constexpr double far = 200.0;           // radii beyond which one node serves for an element: 2e-4 of it

}  // namespace

/// The point, seen as a triangle too small to matter: what a shaft can be made from.
struct Gather::Receiver {
  Vec3 x, normal, leaves;  ///< x in the scene; leaves: zero in free space
  std::uint64_t key;
  geometry::Plane horizon;  ///< relative to the shapes' origin, as is the triangle
  Vec3 local;
  std::array<Vec3, 3> triangle;
};

struct Gather::Rays {
  std::vector<raycast::Segment> segments;
  std::vector<double> weights;
  std::vector<std::uint8_t> blocked;
};

struct Gather::Part {
  scene::SurfacePatch patch;
  double factor;
  std::uint32_t path;  ///< quarters taken, in base 5 with digits 1 .. 4
};

/// An element whose visibility must be sampled, in parts.
struct Gather::Unproved {
  Index element;
  double factor = 0;
  std::vector<Part> parts;
};

Gather::Gather(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches, const raycast::RayCaster& rays,
               std::uint64_t seed, int rays_per_point)
    : patches_(patches),
      rays_(rays),
      seed_(core::derived_seed(seed, "gather")),
      rays_per_point_(rays_per_point),
      shapes_(patches),
      clusters_(clusters_of(patches, shapes_)),
      blockers_(scene, shapes_.origin(), shapes_.plane_tolerance()) {}

/// Cuts a part that is near: its quarters, each with its own factor and rays.
void Gather::add_part(const Receiver& at, const scene::SurfacePatch& part, std::uint32_t path, int depth,
                      Unproved& element) const {
  const double factor = point_to_polygon(at.x, at.normal, part.ring());
  if (factor <= 0.0) return;
  const Vec3 centroid = part.centroid();
  double radius = 0.0;
  for (const Vec3& p : part.ring()) radius = std::max(radius, (p - centroid).norm());
  if (depth < deepest_part && radius > 0.5 * (centroid - at.x).norm()) {
    std::uint32_t digit = 1;
    for (const auto& quarter : quarters_of(part)) add_part(at, quarter, 5 * path + digit++, depth + 1, element);
    return;
  }
  element.parts.push_back({part, factor, path});
}

/// Elements whose visibility must be sampled; those that are proved clear go to `out` at once.
std::vector<Gather::Unproved> Gather::unproved_elements(const Receiver& at, Gathered& out) const {
  std::vector<Unproved> unproved;
  for (const ElementCluster& cluster : clusters_) {
    std::optional<std::vector<std::uint32_t>> candidates;
    for (const Index j : cluster.elements) {
      const ElementShape& shape = shapes_[j];
      const double before = shape.plane.distance(at.local);
      if (before <= shapes_.height_tolerance(shape, at.local) || at.horizon.distance(shape.centroid) <= -shape.radius)
        continue;
      const bool distant = (shape.centroid - at.local).squaredNorm() > far * far * shape.radius * shape.radius &&
                           at.horizon.distance(shape.centroid) > shape.radius;
      const double factor =
          distant ? point_to_polygon_far(at.local, at.normal, shape.centroid, shape.plane.normal, shape.area)
                  : point_to_polygon(at.local, at.normal, shape.ring());
      if (factor <= 0.0) continue;
      if (!candidates && cluster.rectangle)
        candidates = blockers_.candidates(geometry::Shaft(at.triangle, *cluster.rectangle, shapes_.plane_tolerance()));
      const bool clear = (candidates && candidates->empty()) || [&] {
        const geometry::Shaft shaft(at.triangle, shape.ring(), shapes_.plane_tolerance());
        return candidates ? !blockers_.any(shaft, *candidates) : !blockers_.any(shaft);
      }();
      if (clear)
        out.elements.push_back({j, factor, 0.0});
      else
        unproved.push_back({j, factor, {}});
    }
  }
  return unproved;
}

/// The rays to one part, in strata of equal size.
void Gather::cast(const Receiver& at, const Part& part, Index element, int side, Rays& rays) const {
  const Vec3& normal = shapes_[element].plane.normal;
  const ElementMap onto(part.patch);
  rays.segments.clear();
  rays.weights.clear();
  for (int k = 0; k < side * side; ++k) {
    const std::uint32_t number =
        part.path * static_cast<std::uint32_t>(most_rays_per_side * most_rays_per_side) + static_cast<std::uint32_t>(k);
    const auto u = core::random_block(seed_, static_cast<std::uint32_t>(element), at.key, number);
    const int row = k / side, column = k % side;
    const auto y = onto((row + core::uniform_32(u[0])) / side, (column + core::uniform_32(u[1])) / side);
    const Vec3 d = y.position - at.x;
    const double arrives = at.normal.dot(d), leaves = -normal.dot(d), square = d.squaredNorm();
    if (arrives <= 0.0 || leaves <= 0.0) continue;
    rays.segments.push_back({at.x, y.position, at.leaves, normal});
    rays.weights.push_back(y.weight * arrives * leaves / (square * square));
  }
  rays.blocked.resize(rays.segments.size());
  rays_.occluded(rays.segments, rays.blocked);
}

GatheredElement Gather::sampled(const Receiver& at, const Unproved& element, double rays_per_factor,
                                std::uint64_t& rays_cast) const {
  GatheredElement sum{element.element, 0.0, 0.0};
  Rays rays;
  for (const Part& part : element.parts) {
    const int side =
        std::clamp(static_cast<int>(std::lround(std::sqrt(rays_per_factor * part.factor))), 2, most_rays_per_side);
    cast(at, part, element.element, side, rays);
    const SampledVisibility v =
        rays.weights.empty() ? SampledVisibility{0.5, 0.5, 0} : estimated_visibility(rays.weights, rays.blocked);
    rays_cast += rays.weights.size();
    sum.factor += part.factor * v.visible;
    sum.standard_error = std::hypot(sum.standard_error, part.factor * v.standard_error);
  }
  return sum;
}

Gathered Gather::operator()(const measure::PointIrradiance& at, std::uint64_t key,
                            std::span<const double> importance) const {
  const Vec3 local = at.position - shapes_.origin();
  const Receiver receiver{at.position,
                          at.normal,
                          at.on ? at.normal : Vec3::Zero(),
                          key,
                          {at.normal, at.normal.dot(local)},
                          local,
                          geometry::speck(local, at.normal, 8 * shapes_.plane_tolerance())};
  Gathered out;
  std::vector<Unproved> unproved = unproved_elements(receiver, out);
  double total = 0.0;
  for (const Unproved& e : unproved) total += e.factor * importance[static_cast<std::size_t>(e.element)];
  for (Unproved& e : unproved) {
    add_part(receiver, patches_[static_cast<std::size_t>(e.element)], 0, 0, e);
    const double rays_per_factor =
        total > 0.0 ? rays_per_point_ * importance[static_cast<std::size_t>(e.element)] / total : 0.0;
    out.elements.push_back(sampled(receiver, e, rays_per_factor, out.rays));
  }
  std::sort(out.elements.begin(), out.elements.end(),
            [](const auto& a, const auto& b) { return a.element < b.element; });
  return out;
}

Spectrum irradiance(const Gathered& gathered, std::span<const Spectrum> radiosity) {
  Spectrum sum;
  for (const GatheredElement& e : gathered.elements) sum += e.factor * radiosity[static_cast<std::size_t>(e.element)];
  return sum;
}

Spectrum irradiance_noise(const Gathered& gathered, std::span<const Spectrum> radiosity) {
  Spectrum squares;
  for (const GatheredElement& e : gathered.elements) {
    const Spectrum error = e.standard_error * radiosity[static_cast<std::size_t>(e.element)];
    squares += error * error;
  }
  return squares.map([](double s) { return std::sqrt(s); });
}

}  // namespace interflect::fem
