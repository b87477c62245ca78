#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mesh/element_mesh.h"
#include "raycast/ray_caster.h"
#include "scene/scene.h"
#include "visual/scale.h"

namespace interflect::apps {

/// How much of the picture each element is: the rays through a grid of its pixels that meet it; without a camera, its
/// area.  Warns of a camera that sees none.
std::vector<double> shares_in_view(const raycast::RayCaster& rays, const mesh::ElementMesh& mesh,
                                   const std::optional<scene::Camera>& camera);

/// 0 to the most that is in view, or to its 99th percentile where the most is more than twice that.
visual::Range range_in_view(std::span<const double> values, std::span<const double> shares);

}  // namespace interflect::apps
