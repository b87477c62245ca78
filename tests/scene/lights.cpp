#include <gtest/gtest.h>

#include "texts.h"

// The keys "lights" and "sky".
namespace interflect::scene {
namespace {

using test::complaint;
using test::Text;

Scene with(const std::string& keys) { return test::parsed({keys}); }
std::string said(const std::string& keys) { return complaint(Text{keys}); }
std::string said_of_light(const std::string& light) { return said("\"lights\": [" + light + "]"); }

TEST(SceneLights, are_read_in_si_units) {
  Text text{R"("lights": [
    {"type": "point", "position": [100, 0, 200], "flux": 1256.637061435917},
    {"type": "spot", "name": "s", "position": [0, 0, 300], "target": [0, 0, 0], "intensity": 20, "beam_half_angle_deg": 60, "field_half_angle_deg": 90},
    {"type": "sphere", "name": "globe", "centre": [0, 0, 100], "radius": 10, "flux": 50},
    {"type": "sun", "direction": [0, 0, -2], "irradiance": 80000}],
    "sky": {"model": "uniform", "horizontal_illuminance": 10000, "ground_reflectance": 0.2})"};
  text.units = "cm";
  const Lights lights = test::parsed(text).lights;
  ASSERT_EQ(lights.points.size(), 1u);
  EXPECT_EQ(lights.points[0].name, "light-1");
  EXPECT_EQ(lights.points[0].position, Vec3(1, 0, 2));
  EXPECT_NEAR(lights.points[0].intensity[0], 100, 1e-9);
  EXPECT_EQ(lights.spots[0].direction, Vec3(0, 0, -1));
  EXPECT_NEAR(lights.spots[0].cos_beam, .5, 1e-15);
  EXPECT_EQ(lights.spots[0].cos_field, 0);
  EXPECT_NEAR(lights.spots[0].flux()[0], 20 * pi * 1.5, 1e-12);
  EXPECT_NEAR(lights.spheres[0].flux()[0], 50, 1e-12);
  EXPECT_NEAR(lights.spheres[0].radius, .1, 1e-16);
  EXPECT_EQ(lights.suns[0].direction, Vec3(0, 0, -1));
  EXPECT_EQ(lights.suns[0].angular_radius, Sun::seen_from_earth);
  const Sky& sky = std::get<Sky>(lights.sky);
  EXPECT_NEAR(sky.seen(Vec3::UnitZ())[0], 10000 / pi, 1e-9);
  EXPECT_NEAR(sky.seen(-Vec3::UnitZ())[0], 2000 / pi, 1e-9);
  EXPECT_TRUE(with(R"("sky": {"model": "none"})").lights.empty());
}

TEST(SceneLights, say_what_they_need_and_no_more) {
  const std::string here = "s.json:4: /lights/0";
  const std::pair<const char*, std::string> cases[] = {
      {R"({"position": [0,0,1]})", here + ": the key 'type' is missing"},
      {R"({"type": "pont"})", here + "/type: the word 'pont' is not known: did you mean 'point'?"},
      {R"({"type": "point", "position": [0,0,1]})", here + ": one of 'intensity' and 'flux' is expected"},
      {R"({"type": "point", "position": [0,0,1], "intensity": 1, "flux": 2})",
       here + ": one of 'intensity' and 'flux' is expected"},
      {R"({"type": "point", "position": [0,0,1], "intensity": -1})",
       here + "/intensity: -1 is negative: light is not less than nothing"},
      {R"({"type": "point", "position": [0,0,1], "intensity": [1, 2]})",
       here + "/intensity: 2 numbers for a scene of 1 channel"},
      {R"({"type": "point", "position": [0,0,1e16], "intensity": 1})", here + "/position/2: lies"},
      {R"({"type": "point", "position": [0,0,1], "intensity": 1, "radius": 1})",
       here + "/radius: the key 'radius' is not known: one of type, name, position, intensity, flux is expected"},
      {R"({"type": "spot", "position": [0,0,1], "intensity": 1, "beam_half_angle_deg": 10})",
       here + ": one of 'direction' and 'target' is expected"},
      {R"({"type": "spot", "position": [0,0,1], "target": [0,0,1], "intensity": 1, "beam_half_angle_deg": 10})",
       here + "/target: the light aims at itself"},
      {R"({"type": "spot", "position": [0,0,1], "direction": [0,0,0], "intensity": 1, "beam_half_angle_deg": 10})",
       here + "/direction: the zero vector is no direction"},
      {R"({"type": "spot", "position": [0,0,1], "direction": [0,0,1], "intensity": 1, "beam_half_angle_deg": 10, "field_half_angle_deg": 5})",
       here + "/field_half_angle_deg: the field holds the beam: it is no narrower"},
      {R"({"type": "sphere", "centre": [0,0,1], "radius": 0, "flux": 1})", here + "/radius: 0 is not positive"},
      {R"({"type": "sun", "direction": [0,0,-1]})", here + ": the key 'irradiance' is missing"},
      {R"({"type": "sun", "direction": [0,0,-1], "irradiance": 1, "angular_radius_deg": 90})",
       here + "/angular_radius_deg: 90 is outside 0..89"},
      {R"({"type": "sun", "name": "a", "direction": [0,0,-1], "irradiance": 1}, {"type": "sun", "name": "a", "direction": [0,0,-1], "irradiance": 1})",
       "s.json:4: /lights/1/name: the name 'a' is taken"}};
  for (const auto& [light, expected] : cases) {
    const std::string found = said_of_light(light);
    if (expected.ends_with("lies"))
      EXPECT_NE(found.find("/lights/0/position"), std::string::npos) << found;
    else
      EXPECT_EQ(found, expected);
  }
  EXPECT_EQ(said(R"("sky": {})"), "s.json:4: /sky: the key 'model' is missing");
  EXPECT_EQ(said(R"("sky": {"model": "uniform"})"),
            "s.json:4: /sky: one of 'radiance' and 'horizontal_illuminance' is expected");
  EXPECT_EQ(said(R"("sky": {"model": "uniform", "radiance": 1, "ground_reflectance": 2})"),
            "s.json:4: /sky/ground_reflectance: 2 is outside 0..1");
  EXPECT_EQ(said(R"("sky": {"model": "map", "file": "a.exr"})"), "s.json:4: /sky/file: this program reads no pictures");
}

/// 4 x 2 texels of 10 row + column in R, twice and three times that in G and B.
core::Image tiny_picture(const std::filesystem::path&) {
  core::Image picture(4, 2, {"R", "G", "B"});
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x)
      for (int c = 0; c < 3; ++c) picture.at(x, y, c) = static_cast<float>((c + 1) * (10 * y + x));
  return picture;
}

// The picture's middle lies towards +y, or -z of a scene whose y is up; its right half to the right of that.
TEST(SceneSky, looks_as_its_picture_does) {
  const auto sky_of = [](const std::string& more, const std::string& reflectance) {
    Text text{R"("sky": {"model": "map", "file": "sky.hdr", "scale": 2)" + more};
    text.materials = "\"white\": {\"reflectance\": " + reflectance + "}";
    return std::get<EnvironmentMap>(parse_scene(text.str(), "s.json", ".", tiny_picture).lights.sky);
  };
  const EnvironmentMap sky = sky_of("}", "[0.5, 0.5, 0.5]");
  EXPECT_EQ(sky.seen(Vec3(.1, 1, .5).normalized())[0], 2 * 2);
  EXPECT_EQ(sky.seen(Vec3(.1, 1, .5).normalized())[2], 2 * 3 * 2);
  EXPECT_EQ(sky.seen(Vec3(-.1, 1, -.5).normalized())[0], 2 * 11);
  EXPECT_EQ(sky.seen(Vec3(1, -.1, .5).normalized())[0], 2 * 3);
  EXPECT_EQ(sky.seen(Vec3(-1, -.1, .5).normalized())[0], 0);
  EXPECT_EQ(sky_of(", \"rotation_deg\": 90}", "[0.5, 0.5, 0.5]").seen(Vec3(1, -.1, .5).normalized())[0], 2 * 2);
  const EnvironmentMap turned = sky_of("}, \"up\": \"y\"", "[0.5, 0.5, 0.5]");
  EXPECT_EQ(turned.seen(Vec3(.1, .5, -1).normalized())[0], 2 * 2);
  EXPECT_EQ(turned.seen(Vec3(1, .5, .1).normalized())[0], 2 * 3);
  EXPECT_NEAR(sky_of("}", "0.5").seen(Vec3(.1, 1, .5).normalized())[0], 2 * 2 * (.2126 + 2 * .7152 + 3 * .0722), 1e-12);
  Text bad{R"("sky": {"model": "map", "file": "sky.hdr"})", R"("white": {"reflectance": [0.5, 0.5]})"};
  try {
    parse_scene(bad.str(), "s.json", ".", tiny_picture);
    ADD_FAILURE();
  } catch (const core::InputError& error) {
    EXPECT_STREQ(error.what(), "s.json:4: /sky/file: the picture has not the scene's channels");
  }
}

TEST(EnvironmentMap, finds_the_texel_of_a_direction_and_its_solid_angle) {
  const EnvironmentMap map(Vec3::UnitZ(), Vec3::UnitY(), 7, 12, std::vector<Spectrum>(84, Spectrum(1)));
  double sum = 0;
  for (int r = 0; r < 7; ++r)
    for (int c = 0; c < 12; ++c) {
      sum += map.solid_angle(r);
      EXPECT_NEAR(map.solid_angle(r), (map.row_cosine(r) - map.row_cosine(r + 1)) * 2 * pi / 12, 1e-15);
      const Vec3 way = map.direction((map.row_cosine(r) + map.row_cosine(r + 1)) / 2, (c + .5) / 12);
      EXPECT_EQ(map.at(way).row, r);
      EXPECT_EQ(map.at(way).column, c);
    }
  EXPECT_NEAR(sum, 4 * pi, 1e-13);
  for (const Vec3& way : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0, -1, 0), Vec3(-1e-300, -1, 0)}) {
    EXPECT_GE(map.at(way).row, 0);
    EXPECT_LT(map.at(way).row, 7);
    EXPECT_LT(map.at(way).column, 12);
  }
}

}  // namespace
}  // namespace interflect::scene
