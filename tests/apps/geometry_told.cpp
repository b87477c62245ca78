#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/apps/program.h"

namespace interflect::test {
namespace {

using nlohmann::json;

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

}  // namespace
}  // namespace interflect::test
