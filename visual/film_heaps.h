#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scene/camera.h"
#include "visual/shading.h"

namespace interflect::visual {

/// Bodies heaped so that those of a heap lie apart in the picture, and none hides another: each in the first heap where
/// its film rectangle is free.  What reaches behind a pinhole may be anywhere in the picture.
/// @param most  heaps; what finds no place lies in the last one all the same
/// @return      numbers of bodies, ascending in each heap
std::vector<std::vector<std::size_t>> film_heaps(std::span<const Polygons> bodies, const scene::Camera& camera,
                                                 std::size_t most);

}  // namespace interflect::visual
