#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/apps/program.h"

namespace interflect::test {
namespace {

using nlohmann::json;

// Two lamps of four elements each, as two surfaces, and a wall without light.
constexpr const char* two_lamps = R"({
  "format": "interflect/scene/1", "units": "m", "quantity": "radiometric",
  "materials": {
    "grey": { "type": "diffuse", "reflectance": 0.5 },
    "glow": { "type": "diffuse", "reflectance": 0.2, "exitance": 5 }
  },
  "geometry": [
    { "name": "floor", "material": "grey", "polygon": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]] },
    { "name": "lamp", "material": "glow", "polygon": [[-1, -1, 2], [-1, 1, 2], [0, 1, 2], [0, -1, 2]] },
    { "name": "other", "material": "glow", "polygon": [[0.5, -1, 2], [0.5, 1, 2], [1, 1, 2], [1, -1, 2]] }
  ]
})";

// What emits is told as the scene has it, and as it is cut; what is stated is told by its two shares, whose norms are
// at least that of their sum and whose larger one is at most that.
TEST(Shoot, says_what_emits_and_what_its_error_is_of) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("two_lamps.json", two_lamps);
  const auto shoot = [&](const char* unshot, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"shoot", scene,           "-o",       folder / "out", "--element-size",
                                       "3",     "--no-pictures", "--unshot", unshot};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return interflect(arguments);
  };
  double unshot_before = 1e9;
  for (const char* unshot : {"60%", "10%", "1%"}) {
    const Outcome shot = shoot(unshot, {"--json"});
    ASSERT_EQ(shot.status, 0) << shot.err;
    const json said = json::parse(shot.out);
    EXPECT_EQ(said.at("emitting_surfaces"), 2);
    EXPECT_GE(said.at("emitting_elements"), 8);
    const double whole = said.at("relative_error_l2"), of_unshot = said.at("relative_error_l2_of_unshot"),
                 of_elements = said.at("relative_error_l2_of_elements");
    EXPECT_GE(of_unshot + of_elements, whole * (1 - 1e-12));
    EXPECT_GE(whole * (1 + 1e-12), std::max(of_unshot, of_elements));
    EXPECT_LT(of_unshot, unshot_before);
    unshot_before = of_unshot;
  }
  const Outcome told = shoot("10%", {});
  EXPECT_TRUE(contains(told.out, "2 surfaces emit, in ")) << told.out;
  EXPECT_TRUE(contains(told.out, " shots in ")) << told.out;
  EXPECT_TRUE(contains(told.out, "%: what is unshot, ") &&
              contains(told.out, "%: what light varies by inside elements"))
      << told.out;
}

}  // namespace
}  // namespace interflect::test
