#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <sstream>

#include "tests/apps/program.h"

namespace interflect::test {
namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

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
  for (const char* command : {"solve", "validate", "trace", "info", "check"}) {
    const Outcome help = interflect({command, "--help"});
    EXPECT_EQ(help.status, 0) << command;
    EXPECT_TRUE(contains(help.out, "Example:\n  interflect " + std::string(command))) << help.out;
  }
}

TEST(Info, prints_areas_box_and_flux) {
  const Outcome info = interflect({"info", shipped_scene("furnace")});
  EXPECT_EQ(info.status, 0) << info.err;
  EXPECT_TRUE(contains(info.out, "bounding box")) << info.out;
  EXPECT_TRUE(contains(info.out, "closed")) << info.out;
  const Outcome json = interflect({"info", shipped_scene("furnace"), "--json"});
  EXPECT_EQ(json.out.front(), '{');
}

TEST(Check, finds_a_hole_and_a_flipped_wall) {
  EXPECT_EQ(interflect({"check", shipped_scene("furnace")}).status, 0);
  const TemporaryFolder folder;
  const std::string open_cube = folder.write("open.json", R"({ "format": "interflect/scene/1", "units": "m",
  "materials": { "grey": { "type": "diffuse", "reflectance": 0.5, "exitance": 1 } },
  "geometry": [
    { "polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], "material": "grey", "name": "floor" },
    { "polygon": [[0,0,0],[1,0,0],[1,0,1],[0,0,1]], "material": "grey", "name": "flipped" },
    { "polygon": [[1,0,0],[1,0,1],[1,1,1],[1,1,0]], "material": "grey", "name": "wall" } ] })");
  const Outcome check = interflect({"check", open_cube});
  EXPECT_EQ(check.status, 1);
  EXPECT_TRUE(contains(check.out, "open edge")) << check.out;
  EXPECT_TRUE(contains(check.out, "flipped")) << check.out;
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

// The cube with a glowing floor has an exact discrete solution on 4 x 4 constant elements a face, rho = 1/2: mean radiosity of
// floor 1.102645712382, ceiling 0.171829422310, wall 0.181381216327 (an independent code).  Quadrature at 1e-7 leaves about 1e-6.
TEST(Solve, the_cube_has_its_known_discrete_solution) {
  const TemporaryFolder folder;
  const Outcome solve = interflect({"solve", shipped_scene("cube"), "--element-size", "0.25", "--quadrature-tolerance", "1e-7", "-o",
                                    folder / "out", "--no-pictures"});
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

TEST(Solve, a_forecast_writes_nothing) {
  const TemporaryFolder folder;
  const Outcome forecast = interflect({"solve", shipped_scene("office"), "-o", folder / "out", "--forecast"});
  EXPECT_EQ(forecast.status, 0) << forecast.err;
  EXPECT_TRUE(contains(forecast.out, "elements") && contains(forecast.out, "about")) << forecast.out;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST(Validate, certifies_the_cube_and_joins_on_names) {
  const TemporaryFolder folder;
  const Outcome validate = interflect({"validate", shipped_scene("cube"), "--element-size", "0.2", "--all", "-o", folder / "out",
                                       "--picture-spp", "1"});
  EXPECT_EQ(validate.status, 0) << validate.out << validate.err;
  EXPECT_TRUE(contains(validate.out, "of the path-traced reference")) << validate.out;
  for (const char* file : {"validation.json", "validation.vtu", "solution.vtu"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / file)) << file;
  const auto fem = read_csv(folder / "out/surfaces.csv"), traced = read_csv(folder / "out/traced_surfaces.csv");
  ASSERT_EQ(fem.size(), traced.size());
  for (std::size_t i = 0; i < fem.size(); ++i) EXPECT_EQ(fem[i][0], traced[i][0]);
}

TEST(Trace, writes_both_pictures_and_repeats_itself) {
  const TemporaryFolder folder;
  for (const char* name : {"a.exr", "b.exr"}) {
    const Outcome trace = interflect({"trace", shipped_scene("parallel_plates"), "--spp", "2", "-o", folder / name});
    ASSERT_EQ(trace.status, 0) << trace.err;
  }
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "a.png"));
  EXPECT_EQ(read_file(folder / "a.exr"), read_file(folder / "b.exr"));
}

TEST(Interrupted, a_picture_is_kept_with_the_samples_so_far) {
  const TemporaryFolder folder;
  const Outcome trace = interflect({"trace", shipped_scene("cornell_box"), "--spp", "1000000", "-o", folder / "c.exr"},
                                   {.interrupt_after_s = 5});
  EXPECT_EQ(trace.status, 1) << trace.err;
  EXPECT_TRUE(contains(trace.out, "samples a pixel")) << trace.out;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "c.exr") && std::filesystem::exists(folder.path() / "c.png"));
}

TEST(Interrupted, a_solve_without_form_factors_leaves_nothing_half_written) {
  const TemporaryFolder folder;
  const Outcome solve = interflect({"solve", shipped_scene("office"), "--element-size", "0.12", "--max-memory", "9GB", "--quiet", "-o",
                                    folder / "out"},
                                   {.interrupt_after_s = 3});
  EXPECT_EQ(solve.status, 1) << solve.err;
  EXPECT_TRUE(contains(solve.err, "interrupted during")) << solve.err;
  EXPECT_TRUE(std::filesystem::is_empty(folder / "out"));
}

}  // namespace
}  // namespace interflect::test
