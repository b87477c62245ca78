#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "core/vec.h"
#include "results/image_file.h"
#include "tests/apps/program.h"

namespace interflect::test {
namespace {

using nlohmann::json;

/// The lines of a CSV file as cells; none of the files under test quotes a cell.
std::vector<std::vector<std::string>> read_csv(const std::string& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream text(read_file(path));
  for (std::string line; std::getline(text, line);) {
    std::vector<std::string>& row = rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
  }
  return rows;
}

TEST(Program, says_what_it_is) {
  const Outcome version = interflect({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_TRUE(contains(version.out, "interflect 0.1.0"));
}

TEST(Program, each_command_has_help_with_an_example) {
  for (const char* command : {"solve", "validate", "render", "trace", "compare", "view-factors", "compare-form-factors",
                              "solvers", "compare-solvers", "shoot", "dim", "exchange", "info", "check"}) {
    const Outcome help = interflect({command, "--help"});
    EXPECT_EQ(help.status, 0) << command;
    EXPECT_TRUE(contains(help.out, "Example:\n  interflect " + std::string(command))) << help.out;
    EXPECT_FALSE(contains(help.out, "{false}")) << help.out;
  }
}

/// The words of the example in a command's help, its scene and its results where the test has them.
std::vector<std::string> example_of(const std::string& help, const std::string& command,
                                    const TemporaryFolder& folder) {
  const std::size_t begin = help.find("Example:\n  interflect " + command);
  std::istringstream words(help.substr(help.find(command, begin)));
  std::vector<std::string> arguments;
  std::string line;
  std::getline(words, line);
  std::istringstream in_line(line);
  for (std::string word; in_line >> word;) {
    if (word.rfind("data/", 0) == 0) word = INTERFLECT_SOURCE_DIR "/" + word;
    if (!arguments.empty() && arguments.back() == "-o") word = folder / word;
    arguments.push_back(word);
  }
  return arguments;
}

// Stopped after a second where it takes longer: what is no command line, or has no such scene, ends with 2.
TEST(Program, examples_in_help_are_command_lines) {
  for (const char* command : {"solve", "validate", "render", "trace", "compare", "view-factors", "compare-form-factors",
                              "solvers", "compare-solvers", "shoot", "exchange", "info", "check"}) {
    const TemporaryFolder folder;
    std::vector<std::string> example = example_of(interflect({command, "--help"}).out, command, folder);
    for (const char* more : {"--max-time", "1s"}) example.emplace_back(more);
    const Outcome outcome = interflect(example);
    EXPECT_TRUE(outcome.status == 0 || outcome.status == 1) << command << ": " << outcome.status << outcome.err;
    EXPECT_FALSE(contains(outcome.err, "internal error")) << outcome.err;
  }
}

// The furnace is a closed box of 1 m x 2 m x 0.5 m, 7 m² in all, that emits 0.5 W/m².
TEST(Info, prints_areas_box_and_flux) {
  const Outcome info = interflect({"info", shipped_scene("furnace")});
  EXPECT_EQ(info.status, 0) << info.err;
  EXPECT_TRUE(contains(info.out, "6, 12 facets, 7 m2\n")) << info.out;
  EXPECT_TRUE(contains(info.out, "bounding box   1 x 2 x 0.5 m, from (0, 0, 0) to (1, 2, 0.5)\n")) << info.out;
  EXPECT_TRUE(contains(info.out, "emitted flux   3.5 W")) << info.out;
  EXPECT_TRUE(contains(info.out, "geometry       closed\n")) << info.out;
  const auto said = json::parse(interflect({"info", shipped_scene("furnace"), "--json"}).out);
  double area = 0;
  for (const json& surface : said.at("surfaces")) area += surface.at("area").get<double>();
  EXPECT_DOUBLE_EQ(area, 7);
  EXPECT_EQ(said.at("emitted_flux"), json({3.5}));
  EXPECT_EQ(said.at("box_max_m"), json({1.0, 2.0, 0.5}));
  EXPECT_EQ(said.at("closed"), true);
}

// Three walls of a unit cube that meet in a corner; the one in y = 0 looks outwards.
const std::string flipped_corner = R"({ "format": "interflect/scene/1", "units": "m",
  "materials": { "grey": { "type": "diffuse", "reflectance": 0.5, "exitance": 1 } },
  "geometry": [
    { "polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], "material": "grey", "name": "floor" },
    { "polygon": [[0,0,0],[1,0,0],[1,0,1],[0,0,1]], "material": "grey", "name": "south" },
    { "polygon": [[1,0,0],[1,0,1],[1,1,1],[1,1,0]], "material": "grey", "name": "east" } ] })";

TEST(Check, finds_a_hole_and_a_flipped_wall) {
  EXPECT_EQ(interflect({"check", shipped_scene("furnace")}).status, 0);
  const TemporaryFolder folder;
  const Outcome check = interflect({"check", folder.write("corner.json", flipped_corner)});
  EXPECT_EQ(check.status, 1);
  EXPECT_TRUE(contains(check.out, "gap (open edge): 6\n")) << check.out;
  EXPECT_TRUE(contains(check.out, "neighbours face opposite ways: 2\n")) << check.out;
  EXPECT_TRUE(contains(check.out, "floor and south: 1 m")) << check.out;
  EXPECT_TRUE(contains(check.out, "floor sees black backs in ")) << check.out;
  EXPECT_TRUE(contains(check.out, "3 of 3 sides of surfaces see out of the scene")) << check.out;
}

// A unit room with a two-sided sheet that hangs in it.
const std::string room_with_a_sheet = R"({ "format": "interflect/scene/1", "units": "m",
  "materials": { "wall": { "type": "diffuse", "reflectance": 0.5, "exitance": 1 },
                 "sheet": { "type": "diffuse", "reflectance": 0.5, "sides": "both" } },
  "geometry": [
    { "box": { "min": [0,0,0], "max": [1,1,1] }, "facing": "inward", "material": "wall", "name": "room" },
    { "polygon": [[0.3,0.3,0.5],[0.7,0.3,0.5],[0.7,0.7,0.5],[0.3,0.7,0.5]], "material": "sheet", "name": "sheet" } ] })";

TEST(Check, is_content_with_the_rim_of_a_sheet_that_stands_free) {
  const TemporaryFolder folder;
  const Outcome check = interflect({"check", folder.write("sheet.json", room_with_a_sheet)});
  EXPECT_EQ(check.status, 0) << check.out << check.err;
  EXPECT_TRUE(contains(check.out, "rim of a two-sided surface: 4\n")) << check.out;
  EXPECT_TRUE(contains(check.out, "no ray leaves the scene")) << check.out;
}

TEST(Solve, warns_of_flux_on_black_backs) {
  const TemporaryFolder folder;
  const auto warnings = [&](const std::string& scene) {
    const Outcome solve = interflect({"solve", scene, "--element-size", "0.5", "--no-pictures", "-o", folder / "out"});
    EXPECT_EQ(solve.status, 0) << solve.err;
    const json recorded = json::parse(read_file(folder / "out/summary.json")).at("warnings");
    for (const json& warning : recorded) EXPECT_TRUE(contains(solve.err, warning.get<std::string>())) << solve.err;
    return recorded.dump();
  };
  EXPECT_TRUE(
      contains(warnings(folder.write("corner.json", flipped_corner)), "% of the emitted flux: is a surface flipped?"));
  EXPECT_EQ(warnings(shipped_scene("furnace")), "[]");
}

TEST(Solve, writes_every_file_and_the_same_numbers_again) {
  const TemporaryFolder folder;
  const std::vector<std::string> arguments{"solve", shipped_scene("cube"), "--element-size", "0.25", "-o"};
  for (const char* name : {"a", "b"}) {
    std::vector<std::string> with_out = arguments;
    with_out.push_back(folder / name);
    const Outcome solve = interflect(with_out);
    EXPECT_EQ(solve.status, 0) << solve.err;
    EXPECT_TRUE(contains(solve.out, "elements")) << solve.out;
    for (const char* file : {"solution.vtu", "surfaces.csv", "sensors.csv", "summary.json"})
      EXPECT_TRUE(std::filesystem::exists(folder.path() / name / file)) << file;
  }
  for (const char* file : {"/solution.vtu", "/surfaces.csv", "/sensors.csv"})
    EXPECT_EQ(read_file(folder / ("a" + std::string(file))), read_file(folder / ("b" + std::string(file)))) << file;
}

// The cube with a glowing floor has an exact discrete solution on 4 x 4 constant elements a face, rho = 1/2: mean
// radiosity of floor 1.102645712382, ceiling 0.171829422310, wall 0.181381216327 (an independent code).  Quadrature at
// 1e-7 leaves about 1e-6.
TEST(Solve, the_cube_has_its_known_discrete_solution) {
  const TemporaryFolder folder;
  const Outcome solve = interflect({"solve", shipped_scene("cube"), "--element-size", "0.25", "--quadrature-tolerance",
                                    "1e-7", "-o", folder / "out", "--no-pictures"});
  ASSERT_EQ(solve.status, 0) << solve.err;
  const auto rows = read_csv(folder / "out/surfaces.csv");
  ASSERT_EQ(rows.size(), 7u);
  EXPECT_EQ(rows[0][0] + rows[0][1] + rows[0][2], "namearearadiosity_0");
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::string& name = rows[i][0];
    const double expected = name == "floor" ? 1.102645712382 : name == "ceiling" ? 0.171829422310 : 0.181381216327;
    EXPECT_NEAR(std::stod(rows[i][2]), expected, 2e-6) << name;
  }
}

// Every option of the matrix, on an open scene and a closed one.
TEST(Solve, repairs_drops_and_meets_tolerances_as_asked) {
  const TemporaryFolder folder;
  const auto record = [&](const std::string& scene, std::vector<std::string> options, const std::string& said) {
    std::vector<std::string> arguments{"solve", shipped_scene(scene), "--element-size", "0.25", "--no-pictures",
                                       "-o",    folder / "out"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome solve = interflect(arguments);
    EXPECT_EQ(solve.status, 0) << solve.err;
    EXPECT_TRUE(contains(solve.out, said)) << said << " in " << solve.out;
    return json::parse(read_file(folder / "out/summary.json"));
  };
  json r = record("cube", {"--closure", "least-squares"}, "closure     form factors changed by");
  EXPECT_EQ(r.at("settings").at("closure"), "least-squares");
  EXPECT_NEAR(r.at("form_factors").at("row_sum_lowest"), 1, 1e-12);
  r = record("cube", {"--restore-closure"}, "rows        sum_j F_ij: mean 1.000000, from 1.000000 to 1.000000");
  EXPECT_EQ(r.at("settings").at("closure"), "scaling");
  r = record("parallel_plates", {"--closure", "least-squares"}, "environment ");
  EXPECT_NEAR(
      r.at("form_factors").at("environment_mean").get<double>() + r.at("form_factors").at("row_sum_mean").get<double>(),
      1, 1e-12);
  r = record("cube", {"--drop-below", "0.02"}, "of the pairs; dropped sum_j F_ij: mean");
  EXPECT_LT(r.at("form_factors").at("kept_share"), 1);
  EXPECT_GT(r.at("form_factors").at("dropped_mean"), 0);
  EXPECT_LE(r.at("form_factors").at("dropped_mean"), r.at("form_factors").at("dropped_highest"));
  r = record("cube", {"--tolerance", "1e-5"}, "row errors  sum_j |dF_ij| at most");
  EXPECT_LE(r.at("form_factors").at("largest_row_error"), 1e-5);
  EXPECT_EQ(r.at("form_factors").at("tolerance_met"), true);
  r = record("cube", {"--form-factors", "hemisphere-rays", "--samples", "500"}, "elements");
  EXPECT_EQ(r.at("form_factors").at("rays"), 500 * 96);
  r = record("cube", {"--form-factors", "hemicube", "--resolution", "32"}, "elements");
  EXPECT_EQ(r.at("settings").at("resolution"), 32);
}

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

// What the user left out is no fault of the geometry; what was made up for is none at all.
TEST(Solve, tells_what_was_left_out_on_request_from_faults) {
  const TemporaryFolder folder;
  const auto warnings = [&](const std::vector<std::string>& more) {
    std::vector<std::string> command{"solve", shipped_scene("cube"), "--element-size", "0.2", "--no-pictures",
                                     "-o",    folder / "out"};
    command.insert(command.end(), more.begin(), more.end());
    return interflect(command).err;
  };
  const std::string dropped = warnings({"--drop-below", "0.005"});
  EXPECT_TRUE(contains(dropped, "of the emitted flux, likely by the pairs that --drop-below leaves out (")) << dropped;
  EXPECT_FALSE(contains(dropped, "do faces coincide")) << dropped;
  EXPECT_FALSE(contains(warnings({"--drop-below", "0.005", "--closure", "scaling"}), "form factors lose"));
  // A single plane loses what is near the horizon.
  const std::string both = warnings({"--form-factors", "single-plane", "--resolution", "32", "--drop-below", "0.0002"});
  EXPECT_TRUE(contains(both, " (pairs that --drop-below leaves out: some 0.") && contains(both, "do faces coincide"))
      << both;
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
  }
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

// By rays it is known what an open scene loses: their noise is in what is left for form factors.  A closed one loses
// none, and without a matrix there are no form factors.
TEST(Solve, the_energy_balance_says_what_is_noise) {
  const TemporaryFolder folder;
  const auto energy_of = [&](const char* scene, const std::vector<std::string>& more) {
    std::vector<std::string> command{"solve", shipped_scene(scene), "--element-size", "0.5", "--no-pictures",
                                     "-o",    folder / "out"};
    command.insert(command.end(), more.begin(), more.end());
    const std::string text = interflect(command).out;
    const std::size_t at = text.find("energy  ");
    return at == std::string::npos ? text : text.substr(at, text.find('\n', at) - at);
  };
  const char* noise = "% (noise of the rays that escape), left over";
  const std::string open = energy_of("cornell_box", {}), closed = energy_of("cube", {}),
                    sampled = energy_of("cornell_box", {"--solver", "stochastic-jacobi"});
  EXPECT_TRUE(contains(open, "form-factor error ") && contains(open, " % +- ") && contains(open, noise)) << open;
  EXPECT_TRUE(contains(closed, "form-factor error ") && !contains(closed, "noise")) << closed;
  EXPECT_TRUE(!contains(sampled, "form-factor error") && contains(sampled, " (noise)")) << sampled;
}

TEST(Solve, the_summary_says_what_ran) {
  const TemporaryFolder folder;
  const Outcome solve = interflect({"solve", shipped_scene("cube"), "--element-size", "0.5", "--no-pictures", "--seed",
                                    "18446744073709551615", "--threads", "2", "-o", folder / "out"});
  ASSERT_EQ(solve.status, 0) << solve.err;
  EXPECT_TRUE(contains(solve.out, "bounding box 1 x 1 x 1 m")) << solve.out;
  const json summary = json::parse(read_file(folder / "out/summary.json"));
  EXPECT_EQ(summary.at("seed"), ~std::uint64_t{0});
  EXPECT_EQ(summary.at("threads"), 2);
  EXPECT_EQ(summary.at("stopped"), false);
  EXPECT_GT(summary.at("peak_memory_bytes"), 1'000'000);
  EXPECT_LE(summary.at("peak_memory_bytes_by_stage").at("form factors"), summary.at("peak_memory_bytes"));
  const Outcome all = interflect(
      {"solve", shipped_scene("cube"), "--element-size", "0.5", "--no-pictures", "--json", "-o", folder / "out"});
  EXPECT_GT(json::parse(all.out).at("threads"), 0) << "as many as were used, not the 0 that asks for all";
}

TEST(Program, output_that_does_not_arrive_is_no_success) {
  for (const char* option : {"--json", "--quiet"}) {
    const Outcome full = interflect({"info", shipped_scene("furnace"), option}, {.prints_to = "/dev/full"});
    EXPECT_EQ(full.status, 2);
    EXPECT_EQ(full.err, "interflect: standard output cannot be written\n");
  }
}

TEST(Validate, certifies_the_cube_and_joins_on_names) {
  const TemporaryFolder folder;
  const Outcome validate = interflect({"validate", shipped_scene("cube"), "--element-size", "0.2", "--all", "-o",
                                       folder / "out", "--picture-spp", "1"});
  EXPECT_EQ(validate.status, 0) << validate.out << validate.err;
  EXPECT_TRUE(contains(validate.out, "of the path-traced reference")) << validate.out;
  for (const char* file : {"validation.json", "validation.vtu", "solution.vtu"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / file)) << file;
  const auto fem = read_csv(folder / "out/surfaces.csv"), traced = read_csv(folder / "out/traced_surfaces.csv");
  ASSERT_EQ(fem.size(), traced.size());
  for (std::size_t i = 0; i < fem.size(); ++i) EXPECT_EQ(fem[i][0], traced[i][0]);
}

// The largest difference is a part of the mean of all, that of a surface a part of its own.
TEST(Validate, says_what_its_percents_are_of) {
  const TemporaryFolder folder;
  const Outcome validate = interflect({"validate", shipped_scene("cube"), "-o", folder / "out", "--element-size", "0.5",
                                       "--accuracy", "5%", "--no-pictures"});
  EXPECT_TRUE(contains(validate.out, "  max, of mean H  ")) << validate.out;
  EXPECT_TRUE(contains(validate.out, " % of its own H\n")) << validate.out;
}

TEST(Validate, pictures_are_numbered_whatever_cameras_are_called) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("room.json", R"({ "format": "interflect/scene/1", "units": "m",
  "materials": { "grey": { "type": "diffuse", "reflectance": 0.5, "exitance": 1 } },
  "geometry": [ { "box": { "min": [0,0,0], "max": [1,1,1] }, "facing": "inward", "material": "grey" } ],
  "cameras": [ { "name": "a/b", "eye": [0.1,0.1,0.1], "target": [1,1,0.5], "size": [24, 18] },
               { "name": "../c", "eye": [0.9,0.1,0.1], "target": [0,1,0.5], "size": [24, 18] } ] })");
  const Outcome validate = interflect(
      {"validate", scene, "--element-size", "0.5", "--accuracy", "5%", "--picture-spp", "1", "-o", folder / "out"});
  EXPECT_EQ(validate.status, 0) << validate.out << validate.err;
  for (const char* file : {"validation.png", "validation_2.png"})
    EXPECT_EQ(read_file(folder / "out" / file).substr(0, 4), "\x89PNG") << file;
}

// By rays alone: no matrix, and every file that there is with one.
TEST(Solve, is_done_by_rays_alone) {
  const TemporaryFolder folder;
  const Outcome solved = interflect({"solve", shipped_scene("cornell_box"), "--element-size", "0.2", "--solver",
                                     "regular-stochastic-jacobi", "--noise", "3%", "-o", folder / "out"});
  ASSERT_EQ(solved.status, 0) << solved.err;
  EXPECT_TRUE(contains(solved.out, "standard error")) << solved.out;
  EXPECT_FALSE(contains(solved.out, "sum_j F_ij")) << solved.out;
  EXPECT_TRUE(std::filesystem::exists(folder / "out/solution.vtu"));
  const json summary = json::parse(read_file(folder / "out/summary.json"));
  EXPECT_EQ(summary.at("settings").at("solver"), "regular-stochastic-jacobi");
  const Outcome again =
      interflect({"solve", shipped_scene("cornell_box"), "--element-size", "0.2", "--solver",
                  "regular-stochastic-jacobi", "--noise", "3%", "--threads", "3", "-o", folder / "again"});
  EXPECT_EQ(read_file(folder / "out/surfaces.csv"), read_file(folder / "again/surfaces.csv"));
  const Outcome refused = interflect(
      {"solve", shipped_scene("cornell_box"), "--solver", "stochastic-jacobi", "--order", "1", "-o", folder / "no"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(contains(refused.err, "polynomials of order 1")) << refused.err;
  const Outcome stopped =
      interflect({"solve", shipped_scene("cornell_box"), "--element-size", "0.2", "--solver", "shooting-collision",
                  "--noise", "0.001%", "--max-time", "3s", "--no-pictures", "-o", folder / "stopped"});
  EXPECT_TRUE(contains(stopped.out, "out of time") || contains(stopped.out, "asked to stop")) << stopped.out;
  EXPECT_TRUE(std::filesystem::exists(folder / "stopped/solution.vtu"));
}

// What time cut off is had again by the steps that its record says: of iterations, and of rounds of samples.
TEST(Solve, of_a_run_that_was_stopped_can_be_had_again) {
  const TemporaryFolder folder;
  const std::string white = folder.write("white.json", R"({ "format": "interflect/scene/1", "units": "m",
  "materials": { "white": { "type": "diffuse", "reflectance": 0.9999, "exitance": 0.0001 } },
  "geometry": [ { "box": { "min": [0,0,0], "max": [1,1,1] }, "facing": "inward", "material": "white" } ] })");
  const auto solve = [&](const std::string& scene, const std::string& solver, const std::string& out,
                         const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"solve",         scene, "--element-size", "0.1", "--solver", solver,
                                       "--no-pictures", "-o",  folder / out};
    const std::vector<std::string> accuracy =
        solver == "jacobi" ? std::vector<std::string>{"--form-factors", "analytic", "--solver-tolerance", "1e-15"}
                           : std::vector<std::string>{"--noise", "0.001%"};
    for (const auto& also : {accuracy, more}) arguments.insert(arguments.end(), also.begin(), also.end());
    return interflect(arguments);
  };
  for (const auto& [solver, scene] :
       {std::pair<std::string, std::string>{"jacobi", white}, {"shooting-collision", shipped_scene("cornell_box")}}) {
    const Outcome stopped = solve(scene, solver, "stopped", {"--steps", "100000000", "--max-time", "3s"});
    ASSERT_TRUE(contains(stopped.out, "asked to stop")) << stopped.out << stopped.err;
    const json first = json::parse(read_file(folder / "stopped/summary.json")).at("solver");
    ASSERT_GT(first.at("iterations"), 0);
    solve(scene, solver, "again", {"--steps", std::to_string(first.at("iterations").get<int>())});
    const json again = json::parse(read_file(folder / "again/summary.json")).at("solver");
    EXPECT_EQ(again.at("residual_history"), first.at("residual_history")) << solver;
    const auto before = read_csv(folder / "stopped/surfaces.csv"), after = read_csv(folder / "again/surfaces.csv");
    ASSERT_EQ(before.size(), after.size());
    const auto radiosity = 2u, irradiance = before[0].size() > 10 ? 5u : 3u;
    for (std::size_t k = 0; k < before.size(); ++k)
      for (const std::size_t column : {radiosity, irradiance}) EXPECT_EQ(after[k][column], before[k][column]) << solver;
  }
}

// Jacobi's error falls by the reflectance a step: after the 10 000 that there are at most, 0.998^10000 = 2e-9 of it is
// left.
TEST(Validate, a_solver_that_has_not_converged_is_a_reason) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("white.json", R"({ "format": "interflect/scene/1", "units": "m",
  "materials": { "white": { "type": "diffuse", "reflectance": 0.998, "exitance": 0.002 } },
  "geometry": [ { "box": { "min": [0,0,0], "max": [1,1,1] }, "facing": "inward", "material": "white" } ] })");
  const Outcome validate =
      interflect({"validate", scene, "--element-size", "1", "--elements", "1", "--accuracy", "20%", "--no-pictures",
                  "--solver-tolerance", "1e-15", "--solver", "jacobi", "-o", folder / "out"});
  EXPECT_EQ(validate.status, 1) << validate.err;
  EXPECT_TRUE(contains(validate.err, "warning: the solver has not converged: ")) << validate.err;
  EXPECT_TRUE(contains(validate.out, "not validated: the solver has not converged: ")) << validate.out;
  const json certificate = json::parse(read_file(folder / "out/validation.json"));
  EXPECT_EQ(certificate.at("passed"), false);
  EXPECT_TRUE(contains(certificate.at("run").at("warnings").dump(), "has not converged"));
}

// In the furnace every pixel is 1 / pi, gathered or not.
TEST(Render, sees_the_furnace_as_bright_as_it_is) {
  const TemporaryFolder folder;
  const std::vector<std::vector<std::string>> ways{
      {}, {"--order", "1", "--gather", "--rays", "1"}, {"--gather", "--rays", "1", "--form-factors", "analytic"}};
  for (const auto& way : ways) {
    std::vector<std::string> command{"render", shipped_scene("furnace"), "-o", folder / "f.png", "--element-size", "2"};
    command.insert(command.end(), way.begin(), way.end());
    const Outcome render = interflect(command);
    ASSERT_EQ(render.status, 0) << render.err;
    const core::Image image = results::read_exr(folder / "f.exr");
    ASSERT_EQ(image.channels, (std::vector<std::string>{"y", "y.error"}));
    for (int y = 0; y < image.height; y += 7)
      for (int x = 0; x < image.width; x += 7) {
        EXPECT_NEAR(image.at(x, y, 0), inv_pi, 0.01) << x << ' ' << y;
        EXPECT_LE(std::abs(image.at(x, y, 0) - inv_pi), image.at(x, y, 1) + 1e-6);
      }
    EXPECT_EQ(read_file(folder / "f.png").substr(0, 4), "\x89PNG");
  }
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

TEST(Solvers, are_listed_and_compared) {
  const Outcome list = interflect({"solvers"});
  EXPECT_EQ(list.status, 0);
  for (const char* name : {"conjugate-gradients", "southwell", "progressive"})
    EXPECT_TRUE(contains(list.out, name)) << list.out;
  EXPECT_EQ(json::parse(interflect({"solvers", "--json"}).out).at("solvers").at(0).at("name"), "automatic");

  const TemporaryFolder folder;
  const Outcome compared = interflect({"compare-solvers", shipped_scene("cube"), "--element-size", "0.3", "--solvers",
                                       "conjugate-gradients", "southwell", "shooting-collision", "-o", folder / "out"});
  EXPECT_EQ(compared.status, 0) << compared.err;
  EXPECT_TRUE(contains(compared.out, "southwell: converged")) << compared.out;
  const std::string csv = read_file(folder / "out/solvers.csv");
  EXPECT_TRUE(contains(csv, "solver,iteration,rows_or_rays,seconds,error,residual_or_noise")) << csv;
  EXPECT_TRUE(contains(csv, "conjugate-gradients,1,")) << csv;
  EXPECT_EQ(interflect({"compare-solvers", shipped_scene("cube"), "--solvers", "gauss", "-o", folder / "x"}).status, 2);
}

// Why one does not take an open scene is a sentence below the table, not in a column of it.
TEST(Solvers, that_refuse_say_why_below_the_table) {
  const TemporaryFolder folder;
  const Outcome compared =
      interflect({"compare-solvers", shipped_scene("cornell_box"), "--element-size", "0.3", "--solvers", "jacobi",
                  "control-variate-stochastic-jacobi", "-o", folder / "out"});
  EXPECT_EQ(compared.status, 0) << compared.err;
  const std::string table = compared.out.substr(compared.out.find("sweeps to"));
  EXPECT_TRUE(contains(table, "  refused\nrefused: solver 'control-variate-stochastic-jacobi': a closed room expected"))
      << compared.out;
  EXPECT_LT(table.find('\n'), 120u) << table;
}

/// A copy of the office with less flux from the panels of one side.
std::string office_with(const TemporaryFolder& folder, const std::string& flux_of_window_side) {
  std::string text = read_file(shipped_scene("office"));
  const std::string before = "\"flux\": 8000, \"group\": \"window side\"";
  const std::size_t at = text.find(before);
  EXPECT_NE(at, std::string::npos);
  text.replace(at, before.size(), "\"flux\": " + flux_of_window_side + ", \"group\": \"window side\"");
  const std::string file = folder / ("office_" + flux_of_window_side + ".json");
  std::ofstream(file) << text;
  return file;
}

// Nothing that is another run's looks like a part of this one's; what is not the program's stays.
TEST(Solve, removes_what_an_earlier_run_left) {
  const TemporaryFolder folder;
  const auto solve = [&](std::vector<std::string> more) {
    std::vector<std::string> all{"solve", shipped_scene("cube"), "--element-size", "0.5", "-o", folder / "out"};
    all.insert(all.end(), more.begin(), more.end());
    return interflect(all);
  };
  ASSERT_EQ(solve({"--light-groups"}).status, 0);
  const std::filesystem::path out = folder.path() / "out";
  for (const char* file : {"validation.json", "validation_2.png", "bounds_2.png", "traced_sensors.csv", "notes.txt",
                           "bounds_of_mine.png", "validation.txt"})
    std::ofstream(out / file) << "earlier";
  ASSERT_TRUE(std::filesystem::exists(out / "light_groups.h5"));
  ASSERT_EQ(solve({"--no-pictures"}).status, 0);
  for (const char* file : {"validation.json", "validation_2.png", "bounds_2.png", "traced_sensors.csv",
                           "light_groups.h5", "radiosity.png"})
    EXPECT_FALSE(std::filesystem::exists(out / file)) << file;
  for (const char* file : {"notes.txt", "bounds_of_mine.png", "validation.txt", "solution.vtu", "summary.json"})
    EXPECT_TRUE(std::filesystem::exists(out / file)) << file;
}

// Where time is over each group has what rays told of it so far, and all together are the whole within what both state.
TEST(Dim, has_all_groups_of_a_solve_by_rays_that_ran_out_of_time) {
  const TemporaryFolder folder;
  const Outcome solve =
      interflect({"solve", shipped_scene("office"), "--solver", "shooting-collision", "--noise", "0.001%", "--max-time",
                  "1", "--element-size", "0.8", "--light-groups", "--no-pictures", "-o", folder / "out"});
  EXPECT_EQ(solve.status, 1) << solve.err;
  EXPECT_TRUE(contains(solve.err, "--max-time is over")) << solve.err;
  const Outcome dim = interflect({"dim", folder / "out", "-o", folder / "full", "--no-pictures"});
  ASSERT_EQ(dim.status, 0) << dim.err;
  const json whole = json::parse(read_file(folder / "out/summary.json")),
             sum = json::parse(read_file(folder / "full/summary.json"));
  EXPECT_NEAR(sum.at("mean_irradiance").get<double>(), whole.at("mean_irradiance").get<double>(),
              whole.at("mean_irradiance_error").get<double>());
  EXPECT_GT(sum.at("mean_irradiance_error").get<double>(), 0);
  EXPECT_NEAR(sum.at("mean_irradiance").get<double>() / whole.at("mean_irradiance").get<double>(), 1, .03);
}

// What is dimmed is what a solve of the dimmed scene is.
TEST(Dim, is_a_solve_of_the_dimmed_scene) {
  const TemporaryFolder folder;
  const std::string scene = office_with(folder, "8000");
  const std::vector<std::string> settings{"--element-size", "0.5", "--seed", "5"};
  const auto solve = [&](const std::string& file, const std::string& out, std::vector<std::string> more) {
    std::vector<std::string> all{"solve", file, "-o", folder / out, "--no-pictures"};
    all.insert(all.end(), settings.begin(), settings.end());
    all.insert(all.end(), more.begin(), more.end());
    return interflect(all);
  };
  ASSERT_EQ(solve(scene, "lit", {"--light-groups"}).status, 0);
  ASSERT_EQ(solve(office_with(folder, "3200"), "dimmed", {}).status, 0);
  const Outcome dim =
      interflect({"dim", folder / "lit", "--group", "window side=40%", "-o", folder / "by_groups", "--no-pictures"});
  ASSERT_EQ(dim.status, 0) << dim.err;
  EXPECT_TRUE(contains(dim.out, "window side    40 %     3200")) << dim.out;
  const auto solved = read_csv(folder / "dimmed/surfaces.csv"), by_groups = read_csv(folder / "by_groups/surfaces.csv");
  ASSERT_EQ(solved.size(), by_groups.size());
  double largest = 0;
  for (std::size_t k = 1; k < solved.size(); ++k) largest = std::max(largest, std::stod(solved[k][5]));
  for (std::size_t k = 1; k < solved.size(); ++k) {
    EXPECT_EQ(solved[k][0], by_groups[k][0]);
    for (const std::size_t column : {2, 3, 4, 5, 6, 7})
      EXPECT_NEAR(std::stod(by_groups[k][column]), std::stod(solved[k][column]), 1e-7 * largest) << solved[k][0];
    for (const std::size_t column : {8, 9, 10})  // errors are no less
      EXPECT_GE(std::stod(by_groups[k][column]), .99 * std::stod(solved[k][column])) << solved[k][0];
  }
  const auto points = read_csv(folder / "dimmed/sensors.csv"),
             points_by_groups = read_csv(folder / "by_groups/sensors.csv");
  ASSERT_EQ(points.size(), points_by_groups.size());
  for (std::size_t k = 1; k < points.size(); ++k)
    EXPECT_NEAR(std::stod(points[k][8]), std::stod(points_by_groups[k][8]),
                std::stod(points[k][11]) + std::stod(points_by_groups[k][11]));

  const Outcome half = interflect({"dim", folder / "lit", "--no-pictures"});
  EXPECT_EQ(half.status, 0) << half.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "lit/dimmed/sensors.csv"));
  for (const auto& [group, says] : std::vector<std::pair<std::string, std::string>>{
           {"windw side=1", "there is no such light group, only door side, window side"},
           {"window side", "NAME=PART expected"},
           {"window side=-1", "0 or more"},
           {"window side=bright", "0 or more"},
           {"window side=nan", "0 or more"}}) {
    const Outcome bad = interflect({"dim", folder / "lit", "--group", group, "-o", folder / "bad"});
    EXPECT_EQ(bad.status, 2) << group;
    EXPECT_TRUE(contains(bad.err, says)) << bad.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "bad"));
  }
  EXPECT_TRUE(contains(interflect({"dim", folder / "dimmed"}).err, "solve with --light-groups"));
  std::string moved = read_file(scene);
  moved.replace(moved.find("[0.95, 0.7, 3]"), 14, "[0.90, 0.7, 3]");
  std::ofstream(scene) << moved;
  const Outcome changed = interflect({"dim", folder / "lit"});
  EXPECT_EQ(changed.status, 2);
  EXPECT_TRUE(contains(changed.err, "has changed since: solve it again")) << changed.err;
}

}  // namespace
}  // namespace interflect::test
