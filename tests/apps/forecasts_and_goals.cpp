#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/apps/program.h"

namespace interflect::test {
namespace {

using nlohmann::json;

// The ceiling of the cube reflects half of what reaches it and sends 0.1712161 on (known to 5e-7).
TEST(Solve, makes_elements_for_a_goal_and_says_how_it_got_there) {
  const TemporaryFolder folder;
  const Outcome solve = interflect({"solve", shipped_scene("cube"), "-o", folder / "out", "--no-pictures", "--goal",
                                    "ceiling", "--target-error", "0.02%", "--element-size", "2"});
  ASSERT_EQ(solve.status, 0) << solve.err;
  EXPECT_TRUE(contains(solve.out, "E_avg(ceiling) = 0.34")) << solve.out;
  EXPECT_TRUE(contains(solve.out, "W/m2, error <= ")) << solve.out;
  const json summary = json::parse(read_file(folder / "out/summary.json")), made = summary.at("adaptation");
  EXPECT_EQ(made.at("goal"), "ceiling");
  EXPECT_EQ(made.at("met"), true);
  const json last = made.at("passes").back();
  EXPECT_GT(made.at("passes").size(), 1u);
  EXPECT_LE(last.at("relative_error"), 2e-4);
  EXPECT_LT(std::abs(last.at("value").get<double>() - 0.3424322), last.at("error").get<double>() + 1e-6);
  EXPECT_EQ(summary.at("elements"), last.at("elements"));
}

// The last row and what is said at the end are one number, rounded once.
TEST(Solve, tells_of_a_goal_the_same_twice) {
  const TemporaryFolder folder;
  for (const char* target : {"1%", "0.02%"}) {
    const Outcome solve = interflect({"solve", shipped_scene("cube"), "-o", folder / "out", "--no-pictures", "--goal",
                                      "ceiling", "--target-error", target, "--element-size", "2"});
    ASSERT_EQ(solve.status, 0) << solve.err;
    const std::regex pattern(
        R"((\S+) +(\S+) +(\S+ %) +\S+ m?s\nstopped +\S.*\nE_avg\(ceiling\) = (\S+) W/m2, error <= (\S+) W/m2 \((\S+ %),)");
    std::smatch found;
    ASSERT_TRUE(std::regex_search(solve.out, found, pattern)) << solve.out;
    for (int k = 1; k <= 3; ++k) EXPECT_EQ(found.str(k), found.str(k + 3)) << solve.out;
    EXPECT_LE(std::stod(found.str(3)), std::stod(target)) << "rounding is a small part of it";
  }
}

// A furnace of rho .5 in which all emits .5: B = H = 1.
TEST(Solve, proves_bounds_beside_its_estimates) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("furnace.json", R"({ "format": "interflect/scene/1", "units": "m",
    "quantity": "radiometric", "channels": ["y"], "weights": [1],
    "materials": { "grey": { "type": "diffuse", "reflectance": 0.5, "exitance": 0.5 } },
    "geometry": [ { "name": "room", "material": "grey", "box": { "min": [0, 0, 0], "max": [2, 1, 1] }, "facing": "inward" } ],
    "sensors": [ { "name": "middle", "points": [[1, 0.5, 0.5]], "normal": [0, 0, 1] } ] })");
  const Outcome solve =
      interflect({"solve", scene, "-o", folder / "out", "--no-pictures", "--bounds", "--element-size", "0.5"});
  ASSERT_EQ(solve.status, 0) << solve.err;
  EXPECT_TRUE(contains(solve.out, "(mean of all, guaranteed)")) << solve.out;
  EXPECT_TRUE(contains(solve.out, "guaranteed; estimated")) << solve.out;
  const json bounds = json::parse(read_file(folder / "out/summary.json")).at("bounds");
  EXPECT_EQ(bounds.at("claim"), "guaranteed");
  EXPECT_LT(bounds.at("mean_half_width"), 0.05);
  const std::string fields = read_file(folder / "out/solution.vtu");
  for (const char* name : {"irradiance_lower", "irradiance_upper", "mean_irradiance_lower", "mean_irradiance_upper"})
    EXPECT_TRUE(contains(fields, name)) << name;
  EXPECT_TRUE(contains(read_file(folder / "out/sensors.csv"), "error_0,lower_0,upper_0"));
}

TEST(Solve, a_forecast_writes_nothing) {
  const TemporaryFolder folder;
  const Outcome forecast = interflect({"solve", shipped_scene("office"), "-o", folder / "out", "--forecast"});
  EXPECT_EQ(forecast.status, 0) << forecast.err;
  EXPECT_TRUE(contains(forecast.out, "elements") && contains(forecast.out, "about")) << forecast.out;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST(Solve, a_forecast_is_a_result_and_needs_no_folder) {
  for (const char* command : {"solve", "validate"}) {
    const Outcome quiet = interflect({command, shipped_scene("office"), "--forecast", "--quiet"});
    EXPECT_EQ(quiet.status, 0) << quiet.err;
    EXPECT_TRUE(contains(quiet.out, "elements, ")) << quiet.out;
    const Outcome as_json = interflect({command, shipped_scene("office"), "--forecast", "--json"});
    const json said = json::parse(as_json.out);
    for (const char* key : {"elements", "bytes", "seconds"}) EXPECT_GT(said.at(key), 0) << key;
    EXPECT_EQ(said.contains("tracing_seconds"), std::string(command) == "validate");
    const std::string help = interflect({command, "--help"}).out;
    EXPECT_TRUE(contains(help, "--out TEXT REQUIRED without --forecast")) << help;
  }
}

// Bounds are no part of what a forecast measures: so many seconds an element, which differ between scenes.
TEST(Solve, a_forecast_says_what_bounds_take_roughly) {
  const std::vector<std::string> asked{"solve",    shipped_scene("cube"), "--element-size", "0.5",
                                       "--bounds", "--forecast",          "--threads",      "2"};
  const Outcome text = interflect(asked);
  EXPECT_TRUE(contains(text.out, "24 elements, ") && contains(text.out, "; bounds very roughly 1.2 s more ("))
      << text.out;
  std::vector<std::string> as_json = asked;
  as_json.emplace_back("--json");
  EXPECT_DOUBLE_EQ(json::parse(interflect(as_json).out).at("bounds_seconds"), 1.2);
  // How many elements a goal will take is not known.
  const Outcome of_goal = interflect({"solve", shipped_scene("cornell_box"), "--goal", "floor", "--target-error", "5%",
                                      "--bounds", "--forecast", "--threads", "2"});
  EXPECT_TRUE(contains(of_goal.out, "roughly 5.0 s more for every hundred elements of the last pass"))
      << of_goal.out << of_goal.err;
}

}  // namespace
}  // namespace interflect::test
