#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/format.h"
#include "core/vec.h"
#include "results/image_file.h"
#include "tests/apps/csv_rows.h"
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

// Standard errors fall as the root of the number of samples; pixels that find their first light then add to them.
TEST(Trace, tells_of_a_target_that_its_samples_do_not_meet) {
  const TemporaryFolder folder;
  const auto trace = [&](const char* samples) {
    return interflect({"trace", shipped_scene("cornell_box"), "--spp", samples, "--target", "15%", "-o",
                       folder / "p.exr", "--json", "-q"});
  };
  const Outcome missed = trace("32");
  EXPECT_EQ(missed.status, 1);
  EXPECT_TRUE(contains(missed.err, "--target 15.00 % was not met: pixels' standard errors are ")) << missed.err;
  const double error = json::parse(missed.out).at("relative_error");
  EXPECT_GT(error, .15);
  const std::size_t guess = missed.err.find("--spp ");
  ASSERT_NE(guess, std::string::npos) << missed.err;
  const double wanted = std::stod(missed.err.substr(guess + 6));
  EXPECT_NEAR(wanted, 32 * std::pow(error / .15, 2), .1 * wanted);
  EXPECT_TRUE(std::filesystem::exists(folder / "p.checkpoint.h5"));  // to go on from
  const double then = json::parse(trace(core::format("%.0f", wanted).c_str()).out).at("relative_error");
  EXPECT_GT(then, .8 * .15);
  EXPECT_LT(then, 1.2 * .15);
  const Outcome met = trace(core::format("%.0f", 2 * wanted).c_str());
  EXPECT_EQ(met.status, 0) << met.err;
  EXPECT_FALSE(contains(met.err, "--target")) << met.err;
  EXPECT_LE(json::parse(met.out).at("relative_error"), .15);
  EXPECT_TRUE(json::parse(met.out).at("target_met"));
}

// A floor that is lit through glass alone, by a lamp that paths hardly meet, and a display that is seen as it is: pixels
// that found light are good, and most found none.
TEST(Trace, meets_no_target_where_light_is_missing) {
  const TemporaryFolder folder;
  const auto scene = folder.write("scene.json", R"({
    "format": "interflect/scene/1", "units": "m", "quantity": "photometric",
    "materials": {
      "white": { "reflectance": 0.8 }, "display": { "reflectance": 0, "exitance": 100 },
      "lamp": { "reflectance": 0, "flux": 5000 }, "glass": { "type": "dielectric", "index": 1.5 }
    },
    "geometry": [
      { "name": "floor", "material": "white", "polygon": [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]] },
      { "name": "display", "material": "display", "polygon": [[4.01, 0, 0], [4.4, 0, 0], [4.4, 0.4, 0], [4.01, 0.4, 0]] },
      { "name": "lamp", "material": "lamp", "polygon": [[2, 2, 1], [2, 2.004, 1], [2.004, 2.004, 1], [2.004, 2, 1]] },
      { "name": "bulb", "material": "glass", "box": { "min": [1.9, 1.9, 0.9], "max": [2.1, 2.1, 1.1] } }
    ],
    "cameras": [
      { "name": "c", "eye": [2.2, 2, 6], "target": [2.2, 2.001, 0], "fov_y_deg": 45, "size": [64, 64] }
    ]
  })");
  const Outcome outcome =
      interflect({"trace", scene, "--spp", "64", "--target", "15%", "-o", folder / "p.exr", "--json"});
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  const json said = json::parse(outcome.out);
  EXPECT_GT(said.at("dark"), .5);
  EXPECT_FALSE(said.at("target_met"));
  EXPECT_TRUE(contains(outcome.err, "and do not know of all light: light of lamp")) << outcome.err;
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

// By paths from lights the same surfaces.csv, in the same columns, within what both state; what light tracing does not
// find is refused.
TEST(Trace, has_estimates_by_either_integrator) {
  const TemporaryFolder folder;
  const auto trace = [&](const char* integrator, const char* scene) {
    return interflect({"trace", shipped_scene(scene), "--spp", "1", "-o", folder / "p.png", "--estimates",
                       folder / integrator, "--integrator", integrator, "--accuracy", "2%"});
  };
  for (const char* integrator : {"path", "light"}) {
    const Outcome outcome = trace(integrator, "furnace");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(folder / integrator) / "surfaces.csv"));
  }
  const Outcome refused = trace("light", "materials");
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(contains(
      refused.err,
      "light: paths ASE (from a light with an area, by a mirror, pane or smooth glass) are not found at pixels"))
      << refused.err;
}

// Paths that no light can take in the scene would be a black picture, after all the work.
TEST(Trace, refuses_paths_that_the_scene_does_not_have) {
  const TemporaryFolder folder;
  for (const char* paths : {"ED", "LD", "E", "LEL", "PDE", "LGE", "LSSE"}) {
    const Outcome outcome =
        interflect({"trace", shipped_scene("cornell_box"), "--paths", paths, "-o", folder / "x.png"});
    EXPECT_EQ(outcome.status, 2) << paths;
    EXPECT_TRUE(contains(outcome.err, "there are none such in this scene, whose paths are (A)(D)*E")) << outcome.err;
  }
  EXPECT_EQ(folder.files(), 0u);
}

// Unbiased by a solution, as the furnace tells; which paths count is free, and what radiosity cannot solve is refused in
// the integrator's name.
TEST(Trace, is_controlled_by_a_solution_where_there_can_be_one) {
  const TemporaryFolder folder;
  const auto trace = [&](const std::string& scene, const char* paths) {
    return interflect({"trace", scene, "--spp", "4", "-o", folder / "c.exr", "--integrator", "controlled",
                       "--estimates", folder / "tables", "--accuracy", "2%", "--paths", paths});
  };
  const Outcome furnace = trace(shipped_scene("furnace"), "L.*E");
  ASSERT_EQ(furnace.status, 0) << furnace.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "tables/surfaces.csv"));
  const core::Image image = results::read_exr(folder / "c.exr");
  double sum = 0, variance = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      sum += image.at(x, y, 0);
      variance += image.at(x, y, 1) * image.at(x, y, 1);
    }
  const double pixels = image.width * image.height, standard_error = std::sqrt(variance) / pixels;
  EXPECT_LT(standard_error, 1e-3);
  EXPECT_NEAR(sum / pixels, inv_pi, 5 * standard_error + 1e-6);
  EXPECT_EQ(trace(shipped_scene("furnace"), "ADE").status, 0);
  const Outcome bulb = trace(folder.write("bulb.json", bulb_and_lamp), "L.*E");
  EXPECT_EQ(bulb.status, 2);
  EXPECT_TRUE(contains(bulb.err, "controlled starts from a radiosity solution, as path does not, and there is none: "))
      << bulb.err;
  EXPECT_FALSE(contains(bulb.err, "two pass")) << bulb.err;
}

// In the furnace every pixel's radiance is 1 / pi (E = 1 - rho in a closed box).  Of 120 000 independent pixels the
// mean is normal: 5 standard errors are exceeded with a probability of 6e-7.
TEST(Trace, sees_the_furnace_as_bright_as_it_is_and_says_how_sure_it_is) {
  const TemporaryFolder folder;
  const Outcome trace = interflect({"trace", shipped_scene("furnace"), "--spp", "4", "-o", folder / "f.exr"});
  ASSERT_EQ(trace.status, 0) << trace.err;
  const core::Image image = results::read_exr(folder / "f.exr");
  ASSERT_EQ(image.channels, (std::vector<std::string>{"y", "y.error", "samples"}));
  double sum = 0, variance = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      sum += image.at(x, y, 0);
      variance += image.at(x, y, 1) * image.at(x, y, 1);
      EXPECT_EQ(image.at(x, y, 2), 4);
    }
  const double pixels = image.width * image.height, standard_error = std::sqrt(variance) / pixels;
  EXPECT_EQ(pixels, 400 * 300);
  EXPECT_LT(standard_error, 1e-3);
  EXPECT_NEAR(sum / pixels, inv_pi, 5 * standard_error);
}

TEST(Trace, writes_both_pictures_and_repeats_itself) {
  const TemporaryFolder folder;
  for (const std::string threads : {"1", "3"}) {
    const Outcome trace = interflect({"trace", shipped_scene("parallel_plates"), "--spp", "2", "--threads", threads,
                                      "-o", folder / (threads + ".exr")});
    ASSERT_EQ(trace.status, 0) << trace.err;
  }
  EXPECT_EQ(read_file(folder / "1.png").substr(0, 4), "\x89PNG");
  EXPECT_EQ(read_file(folder / "1.exr"), read_file(folder / "3.exr"));
}

TEST(Trace, estimates_join_with_a_solution_on_names) {
  const TemporaryFolder folder;
  const Outcome trace = interflect({"trace", shipped_scene("cube"), "--spp", "1", "-o", folder / "c.exr", "--estimates",
                                    folder / "traced", "--accuracy", "5%"});
  ASSERT_EQ(trace.status, 0) << trace.err;
  const auto rows = read_csv(folder / "traced/surfaces.csv");
  ASSERT_EQ(rows.size(), 7u);
  const auto floor = std::find_if(rows.begin(), rows.end(), [](const auto& row) { return row[0] == "floor"; });
  ASSERT_NE(floor, rows.end());
  // B = 1 + H / 2 is 1.1026 (the_cube_has_its_known_discrete_solution); 5 % of H = 0.2 are 0.005 of B, and elements
  // leave 0.001.
  EXPECT_NEAR(std::stod((*floor)[2]), 1.1026, 0.03);
}

}  // namespace
}  // namespace interflect::test
