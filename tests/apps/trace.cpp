#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/apps/program.h"

// The command `trace`, as a user has it.
namespace interflect::test {
namespace {

using nlohmann::json;

/// A bulb and a lamp above a black floor, and a sensor on it.
constexpr const char* bulb_and_lamp = R"({
  "format": "interflect/scene/1", "units": "m", "quantity": "radiometric",
  "materials": {
    "black": { "type": "diffuse", "reflectance": 0 },
    "glow": { "type": "diffuse", "reflectance": 0, "exitance": 5, "group": "ceiling" }
  },
  "lights": [ { "type": "point", "name": "bulb", "position": [0, 0, 2], "intensity": 3 } ],
  "geometry": [
    { "name": "floor", "material": "black", "polygon": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]] },
    { "name": "lamp", "material": "glow", "polygon": [[-1, -1, 3], [-1, 1, 3], [1, 1, 3], [1, -1, 3]] }
  ],
  "sensors": [ { "name": "middle", "normal": [0, 0, 1], "points": [[0, 0, 0.001]] } ],
  "cameras": [ { "name": "c", "eye": [0, 0, 1], "target": [0, 0.1, 0], "fov_y_deg": 60, "size": [4, 4] } ]
})";

/// Of the only point in sensors.csv, and its error.
std::pair<double, double> sensor_of(const std::filesystem::path& folder) {
  std::istringstream csv(read_file(folder / "sensors.csv"));
  std::string heading, row;
  std::getline(csv, heading);
  std::getline(csv, row);
  const auto field = [&](const std::string& name) {
    std::istringstream headings(heading), fields(row);
    for (std::string h, f; std::getline(headings, h, ',') && std::getline(fields, f, ',');)
      if (h.rfind(name, 0) == 0) return std::stod(f);
    return std::nan("");
  };
  return {field("value"), field("error")};
}

// 3 / 2² below the bulb; 5 times the form factor of a square of 2 m from 3 m below its middle, by Lambert's formula
// (4 / 2 pi)(2 (1 / sqrt(10)) atan(1 / sqrt(10))) = .12332; and both.
TEST(Trace, shows_one_group_of_lights_alone) {
  const TemporaryFolder folder;
  const auto scene = folder.write("scene.json", bulb_and_lamp);
  const auto trace = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all{"trace",          scene,        "--spp", "4",           "-o",
                                 folder / "p.exr", "--accuracy", "0.5%",  "--estimates", folder / "tables"};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = interflect(all);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return sensor_of(folder.path() / "tables");
  };
  const double bulb = .75, leg = 1 / std::sqrt(10.0), lamp = 5 * 4 / (2 * 3.14159265358979) * 2 * leg * std::atan(leg);
  // Below the sensor's own height of 1 mm a part in a thousand is not told.
  for (const auto& [more, truth] : std::vector<std::pair<std::vector<std::string>, double>>{
           {{"--group", "bulb"}, bulb}, {{"--group", "ceiling"}, lamp}, {{}, bulb + lamp}}) {
    const auto [value, error] = trace(more);
    EXPECT_NEAR(value, truth, 2 * error + 2e-3 * truth);
    EXPECT_LT(error, .03 * truth);
  }
  const Outcome unknown = interflect({"trace", scene, "-o", folder / "p.exr", "--group", "sun"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_TRUE(contains(unknown.err, "light group 'sun'") && contains(unknown.err, "ceiling, bulb")) << unknown.err;
}

// Of all integrators, in good scenes: none.
TEST(Trace, tells_how_many_samples_are_no_numbers) {
  const TemporaryFolder folder;
  const Outcome outcome = interflect({"trace", shipped_scene("cornell_box"), "--spp", "16", "-o", folder / "p.exr",
                                      "--estimates", folder / "tables", "--accuracy", "10%", "--json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const json said = json::parse(outcome.out);
  EXPECT_EQ(said.at("pixels_samples_not_finite"), 0);
  EXPECT_EQ(said.at("estimates_samples_not_finite"), 0);
  EXPECT_TRUE(said.contains("pixels_by_one_sample") && said.contains("estimates_by_one_sample")) << outcome.out;
}

}  // namespace
}  // namespace interflect::test
