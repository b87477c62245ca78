#include "fem/ray_transitions.h"

namespace interflect::fem {

RayTransitions::RayTransitions(std::span<const scene::SurfacePatch> patches, const raycast::RayCaster& rays)
    : rays_(rays), locate_(patches) {
  for (const scene::SurfacePatch& patch : patches)
    senders_.push_back({UniformMap(patch.ring()), core::frame_around(patch.normal())});
}

std::optional<Index> RayTransitions::from_element(Index i, std::span<const double> u) const {
  const auto& [map, frame] = senders_[static_cast<std::size_t>(i)];
  const auto hit = rays_.closest({map(u[0], u[1]), frame.to_world(core::cosine_hemisphere(u[2], u[3])), frame.n});
  if (!hit) return std::nullopt;
  const Index j = locate_(*hit);
  return j == ElementLocator::none ? std::nullopt : std::optional<Index>(j);
}

}  // namespace interflect::fem
