#include "scene/io/question_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/format.h"
#include "scene/io/camera_reader.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

constexpr int most_points = 10'000'000;  // of one sensor: beyond, a slip in its spacing is likelier than a wish

Vec3 read_place(const JsonNode& node, const LengthUnit& unit) {
  Placement placement;
  placement.unit = unit;
  return read_place(node, placement);
}

std::variant<double, Eigen::Array2i> read_step(const JsonNode& grid, const LengthUnit& unit) {
  if (grid.has("counts")) {
    const auto counts = grid.at("counts").items(2, 2);
    return Eigen::Array2i(counts[0].integer_in(1, 1000000), counts[1].integer_in(1, 1000000));
  }
  const JsonNode node = grid.at("spacing");
  if (!node.is_string()) return unit.metres(node.positive());
  node.one_of({"en12464"});
  return std::numeric_limits<double>::quiet_NaN();
}

double read_border(const JsonNode& node, const LengthUnit& unit, double shorter_side) {
  const double border = unit.metres(node.number());
  if (border < 0) node.fail("a border is not negative");
  if (2 * border >= shorter_side) node.fail("two borders leave nothing of the grid's shorter side");
  return border;
}

SensorGrid read_grid(const JsonNode& sensor, const LengthUnit& unit) {
  const JsonNode node = sensor.at("grid");
  node.only({"origin", "u", "v", "spacing", "counts"});
  SensorGrid grid{
      read_place(node.at("origin"), unit), read_place(node.at("u"), unit), read_place(node.at("v"), unit), {}, 0};
  const double u = grid.u.norm(), v = grid.v.norm();
  if (!(u > 0)) node.at("u").fail("a side of a grid has a length");
  if (!(v > 0)) node.at("v").fail("a side of a grid has a length");
  if (!(grid.u.cross(grid.v).norm() > 1e-9 * u * v)) node.fail("u and v are parallel: the grid has no area");
  if (sensor.has("exclude_border"))
    grid.exclude_border = read_border(sensor.at("exclude_border"), unit, std::min(u, v));
  if (node.has("spacing") == node.has("counts")) node.fail("one of 'spacing' and 'counts' is expected");
  grid.step = read_step(node, unit);
  const auto [along_u, along_v] = cell_counts(grid);
  if (along_u * along_v > most_points)
    node.at(node.has("counts") ? "counts" : "spacing").fail(core::format("more than %.0e points", double{most_points}));
  return grid;
}

Sensor read_sensor(const JsonNode& node, const LengthUnit& unit) {
  node.only({"name", "normal", "quantity", "exclude_border", "grid", "points"});
  Sensor sensor;
  sensor.name = node.at("name").string();
  if (sensor.name.empty()) node.at("name").fail("a sensor needs a name");
  sensor.normal = read_direction(node.at("normal"));
  if (node.has("quantity")) node.at("quantity").one_of({"irradiance"});
  if (node.has("grid") == node.has("points")) node.fail("one of 'grid' and 'points' is expected");
  if (node.has("grid")) {
    sensor.where = read_grid(node, unit);
    return sensor;
  }
  if (node.has("exclude_border")) node.at("exclude_border").fail("only a grid has a border");
  std::vector<Vec3> points;
  for (const JsonNode& point : node.at("points").items(1)) points.push_back(read_place(point, unit));
  sensor.where = std::move(points);
  return sensor;
}

template <class Named>
void require_new_name(const JsonNode& node, const std::vector<Named>& others, const std::string& name) {
  if (std::any_of(others.begin(), others.end(), [&](const Named& other) { return other.name == name; }))
    node.fail("the name '" + shown_word(name) + "' is taken");
}

}  // namespace

void read_sensors(const JsonNode& sensors, const LengthUnit& unit, Scene& scene) {
  for (const JsonNode& node : sensors.items()) {
    Sensor sensor = read_sensor(node, unit);
    require_new_name(node.at("name"), scene.sensors, sensor.name);
    scene.sensors.push_back(std::move(sensor));
  }
}

void read_cameras(const JsonNode& cameras, const LengthUnit& unit, Scene& scene) {
  for (const JsonNode& node : cameras.items()) {
    Camera camera = read_camera(node, unit, scene);
    require_new_name(node.has("name") ? node.at("name") : node, scene.cameras, camera.name);
    scene.cameras.push_back(std::move(camera));
  }
}

void read_expected(const JsonNode& expected, Scene& scene) {
  std::vector<std::string> names;
  for (const Sensor& sensor : scene.sensors) names.push_back(sensor.name);
  constexpr std::array statistics = {Expected::Statistic::mean, Expected::Statistic::min, Expected::Statistic::max};
  for (const JsonNode& node : expected.items()) {
    node.only({"sensor", "statistic", "value", "tolerance", "source"});
    Expected e;
    e.sensor = node.at("sensor").string();
    if (std::find(names.begin(), names.end(), e.sensor) == names.end())
      node.at("sensor").fail(unknown_word("the sensor", e.sensor, names));
    if (node.has("statistic")) e.statistic = statistics[node.at("statistic").one_of({"mean", "min", "max"})];
    e.value = node.at("value").number();
    e.tolerance = node.at("tolerance").positive();
    if (node.has("source")) e.source = node.at("source").string();
    scene.expected.push_back(std::move(e));
  }
}

}  // namespace interflect::scene::io
