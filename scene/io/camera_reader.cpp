#include "scene/io/camera_reader.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"

namespace interflect::scene::io {
namespace {

constexpr int most_pixels = 65536;  // along one side

const std::vector<std::string> common_keys = {"name", "eye", "target", "up", "size", "projection"};
struct Kind {
  std::string name;
  std::vector<std::string> keys;
};
const std::vector<Kind> kinds = {
    {"pinhole", {"fov_y_deg"}},
    {"thin-lens", {"fov_y_deg", "aperture_radius", "f_number", "sensor_height_mm", "focus_distance"}},
    {"orthographic", {"height"}},
    {"panoramic", {"width_deg", "height_deg"}},
    {"fisheye", {"mapping", "fov_deg"}}};

std::vector<std::string> names_of_kinds() {
  std::vector<std::string> names;
  for (const Kind& kind : kinds) names.push_back(kind.name);
  return names;
}

/// A key of another projection is told as such; one of none, by its neighbours.
void require_keys_of(const Kind& kind, const JsonNode& node) {
  std::vector<std::string> known = common_keys;
  for (const Kind& each : kinds) known.insert(known.end(), each.keys.begin(), each.keys.end());
  node.only(known);
  for (const auto& [key, value] : node.members())
    if (std::find(common_keys.begin(), common_keys.end(), key) == common_keys.end() &&
        std::find(kind.keys.begin(), kind.keys.end(), key) == kind.keys.end())
      value.fail("a camera with the projection '" + kind.name + "' has no '" + key + "'");
}

double angle(const JsonNode& camera, const char* key, double otherwise, double most, bool most_included) {
  if (!camera.has(key)) return otherwise;
  const JsonNode node = camera.at(key);
  const double degrees = node.number_in(0, most);
  if (degrees == 0 || (degrees == most && !most_included))
    node.fail(most_included ? core::format("an angle above 0 and up to %g is expected", most)
                            : core::format("an angle between 0 and %g is expected", most));
  return degrees;
}

double length(const JsonNode& node, const LengthUnit& unit) {
  const double metres = unit.metres(node.positive());
  if (!(metres > 0 && metres <= furthest)) node.fail(core::format("%.9g m is out of reach", metres));
  return metres;
}

/// A lens of focal length f, focused at s, has its sensor at v behind it: 1/f = 1/s + 1/v, and the sensor's half height
/// over v is the tangent of half the angle of view.  Its radius is f / (2 N).
double radius_by_f_number(const JsonNode& camera, const ThinLens& lens) {
  const double number = camera.at("f_number").positive();
  const double sensor = (camera.has("sensor_height_mm") ? camera.at("sensor_height_mm").positive() : 24) / 1000;
  const double v = sensor / 2 / std::tan(lens.fov_y_deg * (pi / 360));
  return lens.focus * v / (lens.focus + v) / (2 * number);
}

ThinLens read_lens(const JsonNode& node, const LengthUnit& unit, const Camera& camera) {
  ThinLens lens;
  lens.fov_y_deg = angle(node, "fov_y_deg", lens.fov_y_deg, 180, false);
  lens.focus =
      node.has("focus_distance") ? length(node.at("focus_distance"), unit) : (camera.target - camera.eye).norm();
  if (node.has("aperture_radius") == node.has("f_number"))
    node.fail("one of 'aperture_radius' and 'f_number' is expected of a thin lens");
  if (node.has("aperture_radius") && node.has("sensor_height_mm"))
    node.at("sensor_height_mm").fail("only an 'f_number' asks for it");
  lens.radius = node.has("aperture_radius") ? length(node.at("aperture_radius"), unit) : radius_by_f_number(node, lens);
  if (!(lens.radius > 0 && lens.radius <= furthest)) node.at("f_number").fail("the lens is out of reach");
  return lens;
}

Projection read_projection(std::size_t kind, const JsonNode& node, const LengthUnit& unit, const Camera& camera) {
  switch (kind) {
    case 0:
      return Pinhole{angle(node, "fov_y_deg", Pinhole{}.fov_y_deg, 180, false)};
    case 1:
      return read_lens(node, unit, camera);
    case 2:
      return Orthographic{length(node.at("height"), unit)};
    case 3:
      return Panoramic{angle(node, "width_deg", 360, 360, true), angle(node, "height_deg", 180, 180, true)};
    default:
      return Fisheye{node.has("mapping") && node.at("mapping").one_of({"equidistant", "equisolid"}) == 1
                         ? Fisheye::Mapping::equisolid
                         : Fisheye::Mapping::equidistant,
                     angle(node, "fov_deg", 180, 360, true)};
  }
}

}  // namespace

Camera read_camera(const JsonNode& node, const LengthUnit& unit, const Scene& scene) {
  Placement in_units;
  in_units.unit = unit;
  const std::size_t kind = node.has("projection") ? node.at("projection").one_of(names_of_kinds()) : 0;
  require_keys_of(kinds[kind], node);
  Camera camera;
  camera.name = node.has("name") ? node.at("name").string() : core::format("camera-%zu", scene.cameras.size() + 1);
  camera.eye = read_place(node.at("eye"), in_units);
  camera.target = read_place(node.at("target"), in_units);
  if (camera.eye == camera.target) node.fail("the camera looks at itself: eye and target are the same point");
  camera.up = node.has("up") ? read_direction(node.at("up")) : scene.up;
  const Vec3 forward = (camera.target - camera.eye).stableNormalized();
  if (!(forward.cross(camera.up).norm() > 1e-9))
    (node.has("up") ? node.at("up") : node).fail("the camera looks along its 'up': give it another");
  camera.projection = read_projection(kind, node, unit, camera);
  if (node.has("size")) {
    const auto size = node.at("size").items(2, 2);
    camera.width = size[0].integer_in(1, most_pixels);
    camera.height = size[1].integer_in(1, most_pixels);
  }
  return camera;
}

}  // namespace interflect::scene::io
