#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/vec.h"
#include "tests/apps/program.h"

// What `info` says of materials and of lights beside surfaces.
namespace interflect::test {
namespace {

using nlohmann::json;

const std::string lit = R"({ "format": "interflect/scene/1", "units": "m", "channels": ["a", "b"],
  "materials": {
    "wood": { "reflectance": [0.5, 0.25] },
    "net": { "reflectance": 0.5, "opacity": 0.25 },
    "brass": { "type": "metal", "reflectance": [0.9, 0.5], "roughness": 0.3 },
    "window": { "type": "glass", "transmittance": 0.75, "index": 1.52 } },
  "geometry": [
    { "polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], "material": "wood" },
    { "polygon": [[0,0,1],[1,0,1],[1,1,1],[0,1,1]], "material": "net" },
    { "polygon": [[0,0,2],[1,0,2],[1,1,2],[0,1,2]], "material": "brass" },
    { "polygon": [[0,0,3],[1,0,3],[1,1,3],[0,1,3]], "material": "window" } ],
  "lights": [
    { "type": "point", "name": "bulb", "position": [1, 2, 3], "intensity": [10, 30] },
    { "type": "sphere", "name": "globe", "centre": [0, 0, 9], "radius": 0.5, "exitance": 2 },
    { "type": "spot", "position": [0, 0, 9], "target": [0, 0, 0], "flux": 90, "beam_half_angle_deg": 30 },
    { "type": "spot", "position": [0, 0, 9], "target": [0, 9, 9], "flux": 80, "beam_half_angle_deg": 30 },
    { "type": "sun", "name": "noon", "direction": [0, 0, -3], "irradiance": 80000 } ],
  "sky": { "model": "uniform", "radiance": 100, "ground_reflectance": 0.25 } })";

TEST(Info, lists_lights_with_the_flux_that_is_finite) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("lit.json", lit);
  const Outcome info = interflect({"info", scene});
  EXPECT_EQ(info.status, 0) << info.err;
  EXPECT_TRUE(contains(info.out, "emitted flux   0 lm (0), of surfaces\n")) << info.out;
  for (const char* line : {"lights         5 (1 point, 2 spots, 1 sphere, 1 sun)\n",
                           "               bulb, point: 251.327 lm, at (1, 2, 3)\n",  // 4 pi 20
                           "               light-3, spot: 90 lm, at (0, 0, 9), towards (0, 0, -1)\n",
                           "               light-4, spot: 80 lm, at (0, 0, 9), towards (0, 1, 0)\n",
                           "               globe, sphere: 6.28319 lm, at (0, 0, 9), radius 0.5 m\n",  // 4 pi R² 2
                           "               noon, sun: 80000 lx across its rays, towards (0, 0, -1)\n",
                           "sky            100 cd/m2, and 25 below the horizon\n"})
    EXPECT_TRUE(contains(info.out, line)) << line << info.out;

  const auto lights = json::parse(interflect({"info", scene, "--json"}).out).at("lights");
  ASSERT_EQ(lights.size(), 6u);
  EXPECT_EQ(lights[0].at("name"), "bulb");
  EXPECT_NEAR(lights[0].at("flux").at(1).get<double>(), 4 * pi * 30, 1e-12);
  EXPECT_EQ(lights[0].at("position_m"), json({1.0, 2.0, 3.0}));
  EXPECT_EQ(lights[1].at("type"), "spot");
  EXPECT_EQ(lights[4].at("irradiance"), json({80000.0, 80000.0}));
  EXPECT_FALSE(lights[4].contains("flux"));
  EXPECT_EQ(lights[5].at("type"), "sky");
  EXPECT_EQ(lights[5].at("ground"), json({25.0, 25.0}));
}

// Light groups are of surfaces: nothing passes for one that no solve heeds.
TEST(LightsBesideSurfaces, are_refused_by_what_solves_by_group) {
  const TemporaryFolder folder;
  const std::string scene = R"({ "format": "interflect/scene/1", "units": "m",
    "materials": { "lamp": { "reflectance": 0.5, "exitance": 1, "group": "ceiling" } },
    "geometry": [ { "polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], "material": "lamp" } ],
    "lights": [ { "type": "point", "name": "bulb", "position": [1, 2, 3], "flux": 9)";
  const Outcome solve =
      interflect({"solve", folder.write("s.json", scene + "} ] }"), "--light-groups", "-o", folder / "out"});
  EXPECT_EQ(solve.status, 2);
  EXPECT_TRUE(contains(solve.err, "'bulb'")) << solve.err;
  const Outcome grouped = interflect({"info", folder.write("g.json", scene + R"(, "group": "ceiling"} ] })")});
  EXPECT_EQ(grouped.status, 2);
  EXPECT_TRUE(contains(grouped.err, "/lights/0/group: the key 'group' is not known")) << grouped.err;
}

TEST(Info, tells_how_materials_scatter) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("lit.json", lit);
  const Outcome info = interflect({"info", scene});
  for (const char* part : {" diffuse\n", " diffuse: opacity 0.25\n", " metal: reflectance 0.9 0.5, roughness 0.3\n",
                           " glass: transmittance 0.75, index 1.52\n"})
    EXPECT_TRUE(contains(info.out, part)) << part << info.out;
  const auto materials = json::parse(interflect({"info", scene, "--json"}).out).at("materials");
  EXPECT_EQ(materials[0].at("finish"), json::object());
  EXPECT_EQ(materials[1].at("finish"), json({{"opacity", 0.25}}));
  EXPECT_EQ(materials[2].at("finish").at("reflectance"), json({0.9, 0.5}));
  EXPECT_EQ(materials[2].at("finish").at("roughness"), 0.3);
  EXPECT_EQ(materials[3].at("finish").at("index"), 1.52);
}

TEST(Info, of_a_scene_without_lights_of_its_own_has_no_line_of_them) {
  const std::string furnace = INTERFLECT_SOURCE_DIR "/data/scenes/furnace.json";
  const Outcome info = interflect({"info", furnace});
  EXPECT_FALSE(contains(info.out, "lights ")) << info.out;
  EXPECT_EQ(json::parse(interflect({"info", furnace, "--json"}).out).at("lights"), json::array());
}

}  // namespace
}  // namespace interflect::test
