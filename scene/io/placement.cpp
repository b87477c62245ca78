#include "scene/io/placement.h"

#include <array>
#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

constexpr std::array<const char*, 5> unit_names = {"m", "cm", "mm", "ft", "in"};
constexpr std::array<LengthUnit, 5> units = {{{1, 1}, {1, 100}, {1, 1000}, {0.3048, 1}, {0.0254, 1}}};

Eigen::Matrix3d rotation(int axis, double degrees) {
  const auto [c, s] = cosine_sine(degrees);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  Eigen::Matrix3d m = Eigen::Matrix3d::Identity();
  m(u, u) = m(v, v) = c;
  m(u, v) = -s;
  m(v, u) = s;
  return m;
}

}  // namespace

std::array<double, 2> cosine_sine(double degrees) {
  const double quarter = std::remainder(degrees, 90.0);
  const int quarters = static_cast<int>(std::lround(std::remainder(degrees - quarter, 360.0) / 90.0));
  const double c = std::cos(quarter * (pi / 180)), s = std::sin(quarter * (pi / 180));
  switch ((quarters + 4) % 4) {
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    case 3:
      return {s, -c};
    default:
      return {c, s};
  }
}

LengthUnit read_unit(const JsonNode& node) { return units[node.one_of({unit_names.begin(), unit_names.end()})]; }

LengthUnit unit_named(const std::string& name) {
  for (std::size_t k = 0; k < units.size(); ++k)
    if (name == unit_names[k]) return units[k];
  throw core::InputError(unknown_word("the unit", name, {unit_names.begin(), unit_names.end()}));
}

std::string out_of_reach(const Vec3& x) {
  return core::format("lies at (%.6g, %.6g, %.6g) m: at most %.0e m from 0 along each axis expected", x.x(), x.y(),
                      x.z(), furthest);
}

void require_extent(const Scene& scene, const std::string& shown) {
  if (const double across = scene.box().diagonal().norm(); !(across >= smallest))
    throw core::InputError(shown, core::format("its surfaces are %.2g m across, all together: %.0e m or more expected; "
                                               "in which unit are its coordinates?",
                                               across, smallest));
}

Vec3 read_place(const JsonNode& node, const Placement& placement) {
  const Vec3 x = placement(node.vec3());
  if (!is_within_reach(x)) node.fail("it " + out_of_reach(x));
  return x;
}

Placement read_placement(const JsonNode& entry, const LengthUnit& unit) {
  Placement placement;
  placement.unit = unit;
  if (!entry.has("transform")) return placement;
  const JsonNode node = entry.at("transform");
  node.only({"scale", "rotate_deg_xyz", "translate"});
  if (node.has("rotate_deg_xyz")) {
    const Vec3 angles = node.at("rotate_deg_xyz").vec3();
    for (int axis = 0; axis < 3; ++axis) placement.linear = rotation(axis, angles[axis]) * placement.linear;
  }
  if (node.has("scale")) placement.linear *= node.at("scale").positive();
  if (node.has("translate")) placement.translation = node.at("translate").vec3();
  return placement;
}

Vec3 read_direction(const JsonNode& node) {
  const Vec3 direction = node.vec3();
  const double length = direction.stableNorm();
  if (!(length > 0)) node.fail("the zero vector is no direction");
  return direction / length;
}

}  // namespace interflect::scene::io
