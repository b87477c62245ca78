#pragma once

#include <array>
#include <string>
#include <vector>

#include "scene/io/json_document.h"
#include "scene/scene.h"

namespace interflect::scene::io {

/// A unit of length: metres = x * factor / divisor, so that 280 cm is the same double as 2.8 m.
struct LengthUnit {
  double factor = 1, divisor = 1;
  double metres(double x) const { return x * factor / divisor; }
  Vec3 metres(const Vec3& x) const { return x * factor / divisor; }
};

/// m | cm | mm | ft | in.
LengthUnit read_unit(const JsonNode& node);
/// @throws core::InputError  with the names known
LengthUnit unit_named(const std::string& name);

/// Cosine and sine of an angle in degrees, exact at multiples of 90.
std::array<double, 2> cosine_sine(double degrees);

/// Where geometry goes: metres(linear x + translation).  It keeps orientation: the determinant of `linear` is positive.
struct Placement {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Vec3 translation = Vec3::Zero();
  LengthUnit unit;
  Vec3 operator()(const Vec3& x) const { return unit.metres(Vec3(linear * x + translation)); }
};

/// Places beyond it, along any axis, are refused [m]: soon after, at 2^53 m, a double no longer resolves a metre; and
/// products of lengths, up to squares of volumes, stay far from overflow.
inline constexpr double furthest = 1e15;
/// Infinite and undefined ones are not.
inline bool is_within_reach(const Vec3& x) { return (x.cwiseAbs().array() <= furthest).all(); }
/// Scenes whose diagonal is shorter are refused [m]: rays are cast in single precision, where squares of areas soon
/// underflow.
inline constexpr double smallest = 1e-15;
/// @throws core::InputError  in one line
void require_extent(const Scene& scene, const std::string& shown);

/// "lies at (1e+100, 0, 0) m: ..".
std::string out_of_reach(const Vec3& x);

/// A place in the scene.
/// @throws core::InputError  where it is out of reach
Vec3 read_place(const JsonNode& node, const Placement& placement);

/// The key "transform" of a geometry entry, where it has one: scaled, then turned about x, y and z of the scene, in
/// this order, then moved.  Multiples of 90 degrees are exact.
Placement read_placement(const JsonNode& entry, const LengthUnit& unit);

/// A unit vector from one of any length but 0.
Vec3 read_direction(const JsonNode& node);

}  // namespace interflect::scene::io
