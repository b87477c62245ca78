#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/apps/csv_rows.h"
#include "tests/apps/program.h"

namespace interflect::test {
namespace {

using nlohmann::json;

// At full output all that a solve says of its only group is said again, the part of the noise that elements share too.
TEST(Dim, states_the_errors_of_the_solve_at_full_output) {
  const TemporaryFolder folder;
  ASSERT_EQ(interflect({"solve", shipped_scene("cube"), "--element-size", "0.25", "--form-factors", "hemisphere-rays",
                        "--samples", "256", "--light-groups", "--no-pictures", "-o", folder / "out"})
                .status,
            0);
  ASSERT_EQ(interflect({"dim", folder / "out", "--no-pictures"}).status, 0);
  const json whole = json::parse(read_file(folder / "out/summary.json")),
             dimmed = json::parse(read_file(folder / "out/dimmed/summary.json"));
  for (const char* what : {"mean_irradiance", "mean_irradiance_error", "relative_error_l2", "relative_noise_l2"})
    EXPECT_NEAR(dimmed.at(what).get<double>(), whole.at(what).get<double>(), 1e-9 * whole.at(what).get<double>())
        << what;
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
    for (const std::size_t column : {8, 9, 10, 11, 12, 13})  // errors are no less, of B and of H
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
