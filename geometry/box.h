#pragma once

#include <Eigen/Geometry>
#include <span>

#include "core/vec.h"

namespace interflect::geometry {

using Box = Eigen::AlignedBox3d;  ///< axis-aligned, closed [m]

Box box_of(std::span<const Vec3> points);

}  // namespace interflect::geometry
