#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "raycast/ray_caster.h"
#include "scene/scene.h"

namespace interflect::fem {

/// A caster whose `closest` is where light comes from along a ray, straight or by mirrors and glass (SpecularChains):
/// by it whatever follows rays from element to element finds all that elements send each other.  What ends on a smooth
/// surface is met there, where no element is.  `occluded` and `all` stay straight.  Of a scene without smooth surfaces
/// the plain caster.
/// @param scene  outlives it; its smooth surfaces treat all channels alike (are_smooth_ones_grey)
/// @throws core::InputError  as raycast::make_ray_caster
std::unique_ptr<raycast::RayCaster> make_light_caster(const std::string& intersector, const scene::Scene& scene,
                                                      std::uint64_t seed);

}  // namespace interflect::fem
