#include <gtest/gtest.h>

#include <cmath>

#include "texts.h"

namespace interflect::scene {
namespace {

using test::parsed;
using test::Text;

constexpr const char* square =
    R"({"polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], "material": "white", "name": "square")";

TEST(SceneFile, lengths_are_metres_after_reading_to_the_last_bit) {
  const std::vector<std::pair<std::string, double>> units{
      {"m", 280}, {"cm", 2.8}, {"mm", 0.28}, {"ft", 280 * 0.3048}, {"in", 280 * 0.0254}};
  for (const auto& [unit, metres] : units) {
    Text text{R"("sensors": [{"name": "s", "normal": [0,0,9], "points": [[280,0,0]]},
                 {"name": "g", "normal": [0,0,1], "exclude_border": 28, "grid": {"origin": [0,0,0], "u": [280,0,0], "v": [0,280,0], "spacing": 28}}],
              "cameras": [{"eye": [280,0,0], "target": [0,0,0]}])",
              R"("white": {"reflectance": 0.5})",
              R"({"polygon": [[0,0,0],[280,0,0],[280,280,0]], "material": "white"})", unit};
    const Scene scene = parsed(text);
    EXPECT_EQ(scene.box().max().x(), metres);
    EXPECT_EQ(std::get<std::vector<Vec3>>(scene.sensors[0].where)[0].x(), metres);
    EXPECT_EQ(scene.sensors[0].normal, Vec3::UnitZ());
    const auto& grid = std::get<SensorGrid>(scene.sensors[1].where);
    EXPECT_EQ(grid.u.x(), metres);
    EXPECT_DOUBLE_EQ(std::get<double>(grid.step), metres / 10);
    EXPECT_DOUBLE_EQ(grid.exclude_border, metres / 10);
    EXPECT_EQ(scene.cameras[0].eye.x(), metres);
  }
}

TEST(SceneFile, cameras_have_projections) {
  const auto projection = [](const std::string& body) {
    Text text{R"("cameras": [{"eye": [200,0,0], "target": [0,0,0])" + body + "}]"};
    text.units = "cm";
    return parsed(text).cameras[0].projection;
  };
  EXPECT_EQ(std::get<Pinhole>(projection("")).fov_y_deg, 50);
  EXPECT_EQ(std::get<Pinhole>(projection(R"(, "projection": "pinhole", "fov_y_deg": 60)")).fov_y_deg, 60);
  const auto lens = std::get<ThinLens>(projection(R"(, "projection": "thin-lens", "aperture_radius": 3)"));
  EXPECT_EQ(lens.radius, 0.03);
  EXPECT_EQ(lens.focus, 2);  // on the target
  // f/2 before a sensor of 24 mm: v = 12 mm / tan 25 deg, 1/f = 1/v + 1/s, R = f / 4.
  const auto by_number =
      std::get<ThinLens>(projection(R"(, "projection": "thin-lens", "f_number": 2, "focus_distance": 150)"));
  const double v = 0.012 / std::tan(25 * pi / 180);
  EXPECT_NEAR(by_number.radius, 1 / (1 / v + 1 / 1.5) / 4, 1e-15);
  EXPECT_EQ(by_number.focus, 1.5);
  EXPECT_EQ(std::get<Orthographic>(projection(R"(, "projection": "orthographic", "height": 150)")).height, 1.5);
  const auto panorama = std::get<Panoramic>(projection(R"(, "projection": "panoramic", "height_deg": 90)"));
  EXPECT_EQ(panorama.width_deg, 360);
  EXPECT_EQ(panorama.height_deg, 90);
  const auto fisheye = std::get<Fisheye>(projection(R"(, "projection": "fisheye", "mapping": "equisolid")"));
  EXPECT_EQ(fisheye.mapping, Fisheye::Mapping::equisolid);
  EXPECT_EQ(fisheye.fov_deg, 180);
}

TEST(SceneFile, conventions_have_their_defaults) {
  const Scene scene = parsed({});
  EXPECT_EQ(scene.quantity, Quantity::photometric);
  EXPECT_EQ(scene.up, Vec3::UnitZ());
  EXPECT_EQ(scene.channels, std::vector<std::string>{"y"});
  EXPECT_EQ(scene.weights[0], 1);
  EXPECT_EQ(scene.surfaces[0].name, "polygon-0");
  const Scene other = parsed(
      {R"("$schema": "x", "up": "y", "quantity": "radiometric", "north_deg": 30, "cameras": [{"eye": [0,0,1], "target": [0,0,0]}])"});
  EXPECT_EQ(other.quantity, Quantity::radiometric);
  EXPECT_EQ(other.cameras[0].up, Vec3::UnitY());
  EXPECT_EQ(other.north_deg, 30);
}

TEST(SceneFile, channels_come_from_the_lengths_of_arrays) {
  const Scene rgb = parsed({"", R"("white": {"reflectance": [0.5, 0.4, 0.3], "exitance": 2})"});
  EXPECT_EQ(rgb.channels, (std::vector<std::string>{"r", "g", "b"}));
  EXPECT_DOUBLE_EQ(rgb.weigh(Spectrum(1.0)), 1);
  EXPECT_EQ(rgb.weights[1], 0.7152);
  const Material& white = rgb.materials[0];
  EXPECT_EQ(white.exitance[0], 2);
  EXPECT_EQ(white.exitance[2], 2);
  EXPECT_EQ(white.reflectance[2], 0.3);
  for (int c = 3; c < Spectrum::capacity; ++c) EXPECT_EQ(white.exitance[c], 0);  // nothing beyond the channels
  const Scene two = parsed({"", R"("white": {"reflectance": [0.5, 0.4]})"});
  EXPECT_EQ(two.channels, (std::vector<std::string>{"band_1", "band_2"}));
  EXPECT_EQ(two.weights[1], 0.5);
}

TEST(SceneFile, flux_is_shared_by_area_over_the_surfaces_that_bear_it) {
  const Scene scene = parsed({"", R"("white": {"reflectance": 0.5, "flux": 3200})",
                              R"({"polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], "material": "white"},
                                 {"polygon": [[0,0,5],[3,0,5],[3,1,5],[0,1,5]], "material": "white"})"});
  EXPECT_DOUBLE_EQ(scene.materials[0].exitance[0], 800);
  EXPECT_DOUBLE_EQ(scene.emitted_flux()[0], 3200);
}

TEST(SceneFile, flux_is_shared_once_where_a_material_has_two_meanings_of_sides) {
  const test::Folder folder;
  folder.write("m.obj", "v 0 0 2\nv 3 0 2\nv 3 1 2\nv 0 1 2\nf 1 2 3 4\n");
  const Scene scene = parsed({"", R"("white": {"reflectance": 0.5, "flux": 3200})",
                              std::string(square) + R"(}, {"file": "m.obj", "unmapped": "white"})"},
                             folder.path());
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[0].sides, Sides::front);
  EXPECT_EQ(scene.materials[1].sides, Sides::both);
  EXPECT_DOUBLE_EQ(scene.emitted_flux()[0], 3200);
  EXPECT_DOUBLE_EQ(scene.materials[1].exitance[0], 800);
}

TEST(SceneFile, sides_that_are_given_hold_everywhere) {
  const test::Folder folder;
  folder.write("m.obj", "v 0 0 2\nv 3 0 2\nv 3 1 2\nf 1 2 3\n");
  const Scene scene = parsed({"", R"("white": {"reflectance": 0.5, "sides": "front"})",
                              std::string(square) + R"(}, {"file": "m.obj", "unmapped": "white"})"},
                             folder.path());
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.materials[0].sides, Sides::front);
}

TEST(SceneFile, holes_are_cut_out) {
  const Scene scene =
      parsed({"", R"("white": {"reflectance": 0.5})",
              std::string(square) + R"(, "holes": [[[0.25,0.25,0],[0.75,0.25,0],[0.75,0.75,0],[0.25,0.75,0]]]})"});
  EXPECT_DOUBLE_EQ(scene.area(SurfaceId{0}), 0.75);
  EXPECT_EQ(scene.surfaces[0].outline->holes.size(), 1u);
}

TEST(SceneFile, boxes_face_outwards_or_inwards) {
  for (const std::string facing : {"outward", "inward"}) {
    const Scene scene =
        parsed({"", R"("white": {"reflectance": 0.5})",
                R"({"box": {"min": [1,2,3], "max": [2,4,6]}, "material": "white", "name": "b", "facing": ")" + facing +
                    "\"}"});
    ASSERT_EQ(scene.surfaces.size(), 6u);
    const Vec3 centre(1.5, 3, 4.5);
    for (const Facet& facet : scene.facets) {
      const double out = facet.normal.dot((facet.corner[0] + facet.corner[1] + facet.corner[2]) / 3 - centre);
      EXPECT_EQ(out > 0, facing == "outward");
    }
    EXPECT_EQ(scene.surfaces[0].name, "b/x-");
    EXPECT_EQ(scene.surfaces[5].name, "b/z+");
    EXPECT_EQ(scene.facets_of(SurfaceId{5})[0].corner[0].z(), 6);
    EXPECT_DOUBLE_EQ(scene.area(SurfaceId{0}), 6);
  }
}

TEST(SceneFile, transforms_scale_then_turn_about_x_y_z_then_move) {
  const Scene scene =
      parsed({"", R"("white": {"reflectance": 0.5})",
              std::string(square) +
                  R"(, "transform": {"scale": 2, "rotate_deg_xyz": [90, 0, 90], "translate": [10, 20, 30]}})"});
  // (x, y, 0) -> 2 (x, y, 0) -> about x: (2x, 0, 2y) -> about z: (0, 2x, 2y) -> moved; quarter turns are exact.
  const auto& ring = scene.surfaces[0].outline->outer;
  EXPECT_EQ(ring[0], Vec3(10, 20, 30));
  EXPECT_EQ(ring[1], Vec3(10, 22, 30));
  EXPECT_EQ(ring[2], Vec3(10, 22, 32));
  EXPECT_EQ(scene.facets[0].normal, Vec3(1, 0, 0));
}

TEST(SceneFile, transforms_keep_a_box_outward) {
  const Scene scene = parsed(
      {"", R"("white": {"reflectance": 0.5})",
       R"({"box": {"min": [-1,-1,-1], "max": [1,1,1]}, "material": "white", "transform": {"rotate_deg_xyz": [33, -71, 120], "scale": 0.3}})"});
  for (const Facet& facet : scene.facets) EXPECT_NEAR(facet.normal.dot(facet.corner[0]), 0.3, 1e-15);
  EXPECT_NEAR(scene.area(SurfaceId{2}), 0.36, 1e-15);
}

TEST(SceneFile, oddities_are_warned_of) {
  const auto warnings = [](const Text& text) {
    std::string all;
    for (const Note& note : parsed(text).warnings) all += note.place + ": " + note.message + "\n";
    return all;
  };
  Text lit{"", R"("white": {"reflectance": 0.5, "exitance": 1})"};
  EXPECT_EQ(warnings(lit), "");
  EXPECT_EQ(warnings({}), "") << "it may be read for its view factors";
  Scene dark = parsed({});
  warn_of_darkness(dark);
  ASSERT_EQ(dark.warnings.size(), 1u);
  EXPECT_EQ(dark.warnings[0].message, "nothing emits: everything will be dark");
  Text unused{"", R"("white": {"reflectance": 0.5, "exitance": 1}, "red": {"reflectance": 0.5})"};
  EXPECT_EQ(warnings(unused), "s.json: the material 'red' is not used\n");
  lit.units = "mm";
  EXPECT_EQ(warnings(lit),
            "s.json: the scene measures 0.001 x 0.001 x 0 m: a side outside 0.1 m .. 1 km; are its \"units\" right?\n");
}

TEST(SceneFile, surfaces_of_one_name_are_told_apart_and_warned_of) {
  const Scene scene = parsed({"", R"("white": {"reflectance": 0.5, "exitance": 1})",
                              std::string(square) + "}, " + square + R"(, "transform": {"translate": [0,0,1]}})"});
  EXPECT_EQ(scene.surfaces[0].name, "square");
  EXPECT_EQ(scene.surfaces[1].name, "square-2");
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0].message, "the name 'square' is given to 2 surfaces: they are numbered");
}

TEST(SceneFile, expectations_and_grids_are_kept) {
  const Scene scene = parsed({R"("sensors": [{"name": "w", "normal": [0,0,1], "quantity": "irradiance",
      "grid": {"origin": [0,0,1], "u": [6,0,0], "v": [0,6,0], "spacing": "en12464"}},
      {"name": "c", "normal": [0,0,1], "grid": {"origin": [0,0,1], "u": [6,0,0], "v": [0,6,0], "counts": [9, 7]}}],
    "expected": [{"sensor": "w", "statistic": "min", "value": 312.4, "tolerance": 0.01, "source": "a book"}])"});
  EXPECT_TRUE(std::isnan(std::get<double>(std::get<SensorGrid>(scene.sensors[0].where).step)));
  EXPECT_EQ(std::get<Eigen::Array2i>(std::get<SensorGrid>(scene.sensors[1].where).step)[1], 7);
  EXPECT_EQ(scene.expected[0].statistic, Expected::Statistic::min);
  EXPECT_EQ(scene.expected[0].value, 312.4);
  EXPECT_EQ(scene.expected[0].source, "a book");
}

}  // namespace
}  // namespace interflect::scene
