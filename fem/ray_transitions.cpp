#include "fem/ray_transitions.h"

#include <algorithm>
#include <array>

#include "fem/polynomial_field.h"
#include "fem/space/polynomials.h"

namespace interflect::fem {

static_assert(ElementLocator::none == solvers::TransitionSampler::nowhere);

RayTransitions::RayTransitions(std::span<const scene::SurfacePatch> patches, const raycast::RayCaster& rays, int order)
    : rays_(rays), locate_(patches), lines_(patches, rays, locate_), functions_(plane_functions(order)) {
  for (const scene::SurfacePatch& patch : patches) {
    senders_.push_back({UniformMap(patch.ring()), core::frame_around(patch.normal())});
    areas_.push_back(patch.area);
  }
  if (order > 0) bases_ = bases_of(order, patches);
}

RayTransitions::Point RayTransitions::point_on(Index element, std::span<const double> u) const {
  return {element, senders_[static_cast<std::size_t>(element)].map(u[0], u[1])};
}

raycast::Ray RayTransitions::ray_from(const Point& point, std::span<const double> u) const {
  const core::Frame& frame = senders_[static_cast<std::size_t>(point.element)].frame;
  return {point.position, frame.to_world(core::cosine_hemisphere(u[0], u[1])), frame.n};
}

std::optional<RayTransitions::Point> RayTransitions::from_point(const Point& point, std::span<const double> u) const {
  const auto hit = rays_.closest(ray_from(point, u));
  if (!hit) return std::nullopt;
  const Index j = locate_(*hit);
  return j == ElementLocator::none ? std::nullopt : std::optional<Point>({j, hit->position});
}

std::optional<Index> RayTransitions::from_element(Index i, std::span<const double> u) const {
  const auto arrived = from_point(point_on(i, u), u.subspan(2));
  return arrived ? std::optional<Index>(arrived->element) : std::nullopt;
}

void RayTransitions::from_elements(std::span<const Index> from, std::span<const double> u,
                                   std::span<Index> arrived) const {
  constexpr std::size_t at_once = 64;  // what they take stays in the first cache
  std::array<raycast::Ray, at_once> rays;
  std::array<std::optional<scene::SurfacePoint>, at_once> hits;
  core::CosineHemisphere<at_once> ways;
  for (std::size_t first = 0; first < from.size(); first += at_once) {
    const std::size_t n = std::min(at_once, from.size() - first);
    for (std::size_t k = 0; k < n; ++k) __builtin_prefetch(&senders_[static_cast<std::size_t>(from[first + k])]);
    for (std::size_t k = 0; k < n; ++k) {
      const auto at = static_cast<Index>(k);
      ways.u[at] = u[4 * (first + k) + 2], ways.v[at] = u[4 * (first + k) + 3];
    }
    ways.find();
    for (std::size_t k = 0; k < n; ++k) {
      const Sender& sender = senders_[static_cast<std::size_t>(from[first + k])];
      rays[k].origin = sender.map(u[4 * (first + k)], u[4 * (first + k) + 1]);
      rays[k].direction = sender.frame.to_world(ways[static_cast<Index>(k)]);
      rays[k].leaves = sender.frame.n;
    }
    rays_.closest_each(std::span(rays).first(n), hits);
    locate_(std::span(hits).first(n), arrived.subspan(first, n));
  }
}

void RayTransitions::functions_at(const Point& point, std::span<double> values) const {
  if (bases_.empty()) {
    values[0] = 1;
    return;
  }
  const PlaneBasis::Values at = bases_[static_cast<std::size_t>(point.element)].at(point.position);
  std::copy(at.begin(), at.end(), values.begin());
}

}  // namespace interflect::fem
