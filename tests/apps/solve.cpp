#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/apps/csv_rows.h"
#include "tests/apps/program.h"

namespace interflect::test {
namespace {

using nlohmann::json;

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

}  // namespace
}  // namespace interflect::test
