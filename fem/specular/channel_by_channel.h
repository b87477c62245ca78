#pragma once

#include <functional>

#include "fem/radiosity.h"

namespace interflect::fem {

/// The scene as one of its channels sees it: one channel, of weight 1.
scene::Scene in_one_channel(const scene::Scene& scene, int channel);

/// A solution whose form factors differ from channel to channel, as those by way of coloured mirrors and glass do: each
/// channel is solved by itself, on the same elements.  Row sums, which are not told by channel, are those of the channel
/// with the largest weight; times are of all, and so is what they fell short of.
/// @param light_groups  whether there are solutions of each, too
/// @param solve         of a scene of one channel
RadiositySolution channel_by_channel(const scene::Scene& scene, bool light_groups,
                                     const std::function<RadiositySolution(const scene::Scene&)>& solve);

}  // namespace interflect::fem
