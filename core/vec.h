#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <numbers>

namespace interflect {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;  ///< positions and lengths in metres; directions of length 1 unless said otherwise
using Index = std::ptrdiff_t;  ///< counts and positions in large arrays

inline constexpr double pi = std::numbers::pi;
inline constexpr double inv_pi = std::numbers::inv_pi;

}  // namespace interflect
