#include <gtest/gtest.h>

#include "tests/apps/csv_table.h"
#include "tests/apps/program.h"

namespace interflect::test {
namespace {

/// Walls that emit 1 - rho, a body that is black and emits 1, a perfect mirror and a pane that absorb nothing: light is
/// the same everywhere in all directions, and on both sides of everything H = 1.
const char* const mirrored_furnace = R"({ "format": "interflect/scene/1", "units": "m", "quantity": "radiometric",
  "materials": {
    "glowing": { "type": "diffuse", "reflectance": 0.5, "exitance": 0.5 },
    "black": { "type": "diffuse", "reflectance": 0, "exitance": 1 },
    "mirror": { "type": "mirror", "reflectance": 1, "sides": "both" },
    "pane": { "type": "glass", "transmittance": 0.92307692307, "index": 1.5 } },
  "geometry": [
    { "name": "room", "material": "glowing", "facing": "inward", "box": { "min": [0,0,0], "max": [2,1,1] } },
    { "name": "body", "material": "black", "box": { "min": [1.4,0.3,0.2], "max": [1.8,0.7,0.6] } },
    { "name": "mirror", "material": "mirror", "polygon": [[0.3,0.2,0.1],[0.3,0.8,0.1],[0.3,0.8,0.9],[0.3,0.2,0.9]] },
    { "name": "pane", "material": "pane", "polygon": [[0.9,0.1,0.1],[0.9,0.9,0.1],[0.9,0.9,0.9],[0.9,0.1,0.9]] }
  ],
  "cameras": [ { "name": "c", "eye": [0.1,0.1,0.1], "target": [1,0.5,0.5], "size": [8, 6] } ] })";

/// Each H with its error.  Of noise alone 2.2 half widths are 4.3 standard errors, which one of 20 values exceeds with
/// a probability of 4e-4.
void expect_irradiance_of_one(const CsvTable& table) {
  for (const std::string& name : table.names())
    for (const std::string channel : {"_0", ""}) {
      const double error = table.at(name, "irradiance_error" + channel);
      EXPECT_GT(error, 0) << name;
      EXPECT_LT(error, .2) << name;
      EXPECT_NEAR(table.at(name, "irradiance" + channel), 1, 2.2 * error) << name;
    }
}

TEST(SurfaceTables, have_an_error_of_irradiance_on_black_bodies_mirrors_and_glass) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("furnace.json", mirrored_furnace);
  const Outcome trace = interflect(
      {"trace", scene, "--spp", "1", "-o", folder / "c.png", "--estimates", folder / "traced", "--accuracy", "2%"});
  ASSERT_EQ(trace.status, 0) << trace.err;
  const CsvTable traced(folder / "traced/surfaces.csv");
  EXPECT_EQ(traced.names().size(), 16u) << "sides of the mirror and of the pane too";
  expect_irradiance_of_one(traced);
  for (const std::string name : {"mirror", "mirror/back", "pane", "pane/back"}) {
    EXPECT_TRUE(std::isnan(traced.at(name, "radiosity"))) << name << " throws on what rho does not tell";
    EXPECT_TRUE(std::isinf(traced.at(name, "error"))) << name;
  }
  EXPECT_EQ(traced.at("body/x-", "radiosity"), 1);
  EXPECT_EQ(traced.at("body/x-", "error"), 0);
  EXPECT_NEAR(traced.at("room/z+", "error"), .5 * traced.at("room/z+", "irradiance_error"), 1e-9);
}

// Of the same furnace, whose mirror and pane have no elements.
TEST(SurfaceTables, of_finite_elements_have_errors_of_black_bodies_too) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("furnace.json", mirrored_furnace);
  const Outcome solve = interflect({"solve", scene, "--element-size", "0.4", "--no-pictures", "-o", folder / "out"});
  ASSERT_EQ(solve.status, 0) << solve.err;
  const CsvTable solved(folder / "out/surfaces.csv");
  EXPECT_EQ(solved.names().size(), 12u);
  EXPECT_FALSE(solved.has("mirror") || solved.has("pane"));
  expect_irradiance_of_one(solved);
  EXPECT_EQ(solved.at("body/x-", "error"), 0);
  EXPECT_NEAR(solved.at("room/z+", "error"), .5 * solved.at("room/z+", "irradiance_error"), 1e-9);
}

// Both of the same surfaces, by names; what is stopped before its solver is done knows no error but of what is black.
TEST(SurfaceTables, agree_within_their_errors_and_say_what_is_not_known) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("room.json", R"({ "format": "interflect/scene/1", "units": "m",
  "quantity": "radiometric",
  "materials": { "grey": { "type": "diffuse", "reflectance": 0.6 }, "black": { "type": "diffuse", "reflectance": 0 },
                 "lamp": { "type": "diffuse", "reflectance": 0, "exitance": 100 } },
  "geometry": [ { "name": "floor", "material": "black", "polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]] },
                { "name": "lamp", "material": "lamp", "polygon": [[0,0,1],[0,1,1],[1,1,1],[1,0,1]] },
                { "name": "left", "material": "grey", "polygon": [[0,0,0],[0,1,0],[0,1,1],[0,0,1]] },
                { "name": "right", "material": "grey", "polygon": [[1,0,0],[1,0,1],[1,1,1],[1,1,0]] } ] })");
  const Outcome validate = interflect(
      {"validate", scene, "--element-size", "0.25", "--accuracy", "1%", "--no-pictures", "-o", folder / "out"});
  ASSERT_EQ(validate.status, 0) << validate.out << validate.err;
  const CsvTable solved(folder / "out/surfaces.csv"), traced(folder / "out/traced_surfaces.csv");
  ASSERT_EQ(solved.names(), traced.names());
  for (const std::string& name : solved.names()) {
    const double of_solved = solved.at(name, "irradiance_error"), of_traced = traced.at(name, "irradiance_error");
    EXPECT_GT(of_solved, 0) << name;
    EXPECT_GT(of_traced, 0) << name;
    EXPECT_LT(of_traced, 1.96 * 1.5 * .01 * traced.at(name, "irradiance")) << "--accuracy is one standard error";
    EXPECT_NEAR(solved.at(name, "irradiance"), traced.at(name, "irradiance"), of_solved + 2.2 * of_traced) << name;
  }
  const Outcome stopped = interflect({"solve", scene, "--element-size", "0.25", "--solver", "jacobi", "--steps", "1",
                                      "--no-pictures", "-o", folder / "stopped"});
  EXPECT_EQ(stopped.status, 1) << stopped.err;
  const CsvTable early(folder / "stopped/surfaces.csv");
  EXPECT_TRUE(std::isinf(early.at("left", "irradiance_error")));
  EXPECT_TRUE(std::isinf(early.at("left", "error")));
  EXPECT_TRUE(std::isinf(early.at("floor", "irradiance_error")));
  EXPECT_EQ(early.at("floor", "error"), 0) << "it reflects nothing, whatever arrives";
}

}  // namespace
}  // namespace interflect::test
