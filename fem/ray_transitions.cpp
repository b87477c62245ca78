#include "fem/ray_transitions.h"

#include "fem/space/polynomials.h"

namespace interflect::fem {

RayTransitions::RayTransitions(std::span<const scene::SurfacePatch> patches, const raycast::RayCaster& rays, int order)
    : rays_(rays), locate_(patches), lines_(patches, rays, locate_), functions_(plane_functions(order)) {
  for (const scene::SurfacePatch& patch : patches) {
    senders_.push_back({UniformMap(patch.ring()), core::frame_around(patch.normal())});
    areas_.push_back(patch.area);
    if (order > 0) bases_.emplace_back(order, patch.ring(), patch.normal());
  }
}

RayTransitions::Point RayTransitions::point_on(Index element, std::span<const double> u) const {
  return {element, senders_[static_cast<std::size_t>(element)].map(u[0], u[1])};
}

std::optional<RayTransitions::Point> RayTransitions::from_point(const Point& point, std::span<const double> u) const {
  const core::Frame& frame = senders_[static_cast<std::size_t>(point.element)].frame;
  const auto hit = rays_.closest({point.position, frame.to_world(core::cosine_hemisphere(u[0], u[1])), frame.n});
  if (!hit) return std::nullopt;
  const Index j = locate_(*hit);
  return j == ElementLocator::none ? std::nullopt : std::optional<Point>({j, hit->position});
}

std::optional<Index> RayTransitions::from_element(Index i, std::span<const double> u) const {
  const auto arrived = from_point(point_on(i, u), u.subspan(2));
  return arrived ? std::optional<Index>(arrived->element) : std::nullopt;
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
