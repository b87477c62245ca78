#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/apps/csv_rows.h"
#include "tests/apps/program.h"

namespace interflect::test {
namespace {

using nlohmann::json;

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

TEST(Validate, is_by_nothing_that_knows_a_solution) {
  const TemporaryFolder folder;
  for (const char* integrator : {"controlled", "two-pass"}) {
    const Outcome validate =
        interflect({"validate", shipped_scene("cube"), "--integrator", integrator, "-o", folder / "out"});
    EXPECT_EQ(validate.status, 2);
    EXPECT_TRUE(contains(validate.err, "one expected that knows nothing of a radiosity solution")) << validate.err;
  }
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

}  // namespace
}  // namespace interflect::test
