#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/vec.h"
#include "results/image_file.h"
#include "tests/apps/program.h"

namespace interflect::test {
namespace {

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

// Beside a pane more rays, unless so many are asked for: a few of them are mirrored by chance, which is speckle.
TEST(Render, takes_more_rays_beside_glass) {
  const TemporaryFolder folder;
  const auto rays = [&](const std::string& material, const std::vector<std::string>& more) {
    const std::string scene = folder.write("room.json", R"({ "format": "interflect/scene/1", "units": "m",
      "materials": { "glow": { "type": "diffuse", "reflectance": 0.5, "exitance": 1 }, "sheet": )" +
                                                            material + R"( },
      "geometry": [
        { "name": "room", "material": "glow", "box": { "min": [0, 0, 0], "max": [1, 1, 1] }, "facing": "inward" },
        { "name": "sheet", "material": "sheet", "polygon": [[0.5, 0.2, 0.2], [0.5, 0.8, 0.2], [0.5, 0.5, 0.8]] } ],
      "cameras": [ { "name": "c", "eye": [0.9, 0.5, 0.5], "target": [0, 0.5, 0.5], "fov_y_deg": 60, "size": [2, 2] } ]
      })");
    std::vector<std::string> command{"render", scene, "-o", folder / "f.exr", "--element-size", "1", "--json"};
    command.insert(command.end(), more.begin(), more.end());
    const Outcome render = interflect(command);
    EXPECT_EQ(render.status, 0) << render.err;
    return nlohmann::json::parse(render.out).at("rays").get<int>();
  };
  const std::string pane = R"({ "type": "glass", "transmittance": 0.9 })";
  EXPECT_EQ(rays(R"({ "type": "diffuse", "reflectance": 0.5 })", {}), 4);
  EXPECT_EQ(rays(pane, {}), 64);
  EXPECT_EQ(rays(pane, {"--gather"}), 16);
  EXPECT_EQ(rays(pane, {"--rays", "9"}), 9);
}

}  // namespace
}  // namespace interflect::test
