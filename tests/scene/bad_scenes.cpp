#include <gtest/gtest.h>

#include "texts.h"

namespace interflect::scene {
namespace {

using test::complaint;
using test::Text;

/// Bad scenes, and where and what is said of each.
struct Case {
  Text text;
  std::string said;
};

void expect_all(const std::vector<Case>& cases) {
  for (const Case& c : cases) EXPECT_EQ(complaint(c.text), c.said);
}

Text with_material(const std::string& body) { return {"", "\"white\": {" + body + "}"}; }
Text with_geometry(const std::string& body) { return {"", R"("white": {"reflectance": 0.5})", body}; }

TEST(BadScene, files_that_cannot_be_read_are_named) {
  const test::Folder folder;
  const auto said_of = [](const std::filesystem::path& file) -> std::string {
    try {
      read_scene(file);
      return "read";
    } catch (const core::InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(said_of("/nowhere/office.json"), "/nowhere/office.json: there is no such file");
  EXPECT_EQ(said_of(folder.path()), folder.path().string() + ": this is a directory: a file is expected");
  EXPECT_EQ(said_of("/dev/null"), "/dev/null: this is not a regular file");
  EXPECT_EQ(said_of(folder.write("empty.json", "")),
            (folder.path() / "empty.json").string() + ": the file is empty: a JSON object is expected");
  EXPECT_EQ(said_of(folder.write("good.json", Text{}.str())), "read");
}

TEST(BadScene, the_document_is_an_interflect_scene) {
  EXPECT_EQ(complaint("[]"), "s.json:1: /: a scene is a JSON object");
  EXPECT_EQ(complaint("{}"), "s.json:1: /: the key 'format' is missing");
  EXPECT_EQ(complaint("{\"format\": \"interflect/scene/2\"}"),
            "s.json:1: /format: \"interflect/scene/1\" is expected, not \"interflect/scene/2\"");
  EXPECT_EQ(complaint("{\"format\": \"interflect/scene/1\"}"), "s.json:1: /: the key 'units' is missing");
}

TEST(BadScene, unknown_keys_and_words_bring_the_nearest_known_one) {
  expect_all(
      {{{R"("chanels": ["y"])"}, "s.json:4: /chanels: the key 'chanels' is not known: did you mean 'channels'?"},
       {{R"("up": "x")"}, "s.json:4: /up: the word 'x' is not known: did you mean 'z'?"},
       {{R"("quantity": "photometrical")"},
        "s.json:4: /quantity: the word 'photometrical' is not known: did you mean 'photometric'?"},
       {with_material(R"("reflectence": 0.5)"),
        "s.json:4: /materials/white/reflectence: the key 'reflectence' is not known: did you mean 'reflectance'?"},
       {{"", R"("white": {"reflectance": 0.5})", R"({"polygn": [], "material": "white"})"},
        "s.json:5: /geometry/0/polygn: the key 'polygn' is not known: did you mean 'polygon'?"}});
  Text unit;
  unit.units = "metre";
  EXPECT_EQ(complaint(unit), "s.json:3: /units: the word 'metre' is not known: one of m, cm, mm, ft, in is expected");
}

TEST(BadScene, what_this_version_does_not_know_is_said_in_so_many_words) {
  expect_all({{{R"("luminaires": [])"}, "s.json:4: /luminaires: this version does not know \"luminaires\""},
              {{R"("photometry": {})"}, "s.json:4: /photometry: this version does not know \"photometry\""},
              {{R"("sky": {"model": "cie"})"},
               "s.json:4: /sky/model: the word 'cie' is not known: one of none, uniform, map is expected"},
              {with_material(R"("type": "difuse", "reflectance": 0.8)"),
               "s.json:4: /materials/white/type: the type 'difuse' is not known: did you mean 'diffuse'?"},
              {with_material(R"("reflectance": {"spectrum": "a.csv"})"),
               "s.json:4: /materials/white/reflectance: this version does not know spectra from files: a number or an "
               "array is expected"}});
}

TEST(BadScene, materials_say_what_their_type_needs_and_no_more) {
  const std::string here = "s.json:4: /materials/white";
  expect_all(
      {{with_material(R"("type": "mirror")"), here + ": the key 'reflectance' is missing"},
       {with_material(R"("type": "mirror", "reflectance": 1.1)"), here + "/reflectance: 1.1 is outside 0..1"},
       {with_material(R"("type": "mirror", "reflectance": 0.5, "roughness": 0.1)"),
        here + "/roughness: the key 'roughness' is not known: one of reflectance, type, exitance, flux, sides, group, "
               "opacity is expected"},
       {with_material(R"("type": "metal", "roughness": 0.1)"),
        here + ": a reflectance at normal incidence is expected of a metal, or eta and k"},
       {with_material(R"("type": "metal", "reflectance": 0.9, "eta": 0.2, "k": 3)"),
        here + ": a reflectance at normal incidence is expected of a metal, or eta and k"},
       {with_material(R"("type": "metal", "eta": 0.2)"), here + ": the key 'k' is missing"},
       {with_material(R"("type": "metal", "eta": 0, "k": 3)"), here + "/eta: 0 is not positive"},
       {with_material(R"("type": "metal", "reflectance": 0.9, "roughness": 2)"),
        here + "/roughness: 2 is outside 0..1"},
       {with_material(R"("type": "dielectric", "index": 0.1)"), here + "/index: 0.1 is outside 0.2..5"},
       {with_material(R"("type": "dielectric", "exitance": 5)"),
        here + "/exitance: what is clear does not emit: give the light a surface of its own"},
       {with_material(R"("type": "glass", "transmittance": 0.8, "sides": "front")"),
        here + "/sides: light passes both sides of what is clear: \"both\" is expected, or nothing"},
       {with_material(R"("type": "glass", "transmittance": 0.95)"),
        here + "/transmittance: 0.95: clear glass of index 1.5 transmits 0.923077, what is left is reflected"},
       {with_material(R"("type": "plastic", "reflectance": 1)"),
        here + "/reflectance: a reflectance of 1 is not below 1: every surface absorbs some light"},
       {with_material(R"("reflectance": 0.5, "opacity": 0.5, "exitance": 1)"),
        here + "/opacity: what emits is all there"},
       {with_material(R"("reflectance": 0.5, "opacity": 1.5)"), here + "/opacity: 1.5 is outside 0..1"}});
}

TEST(BadScene, materials_conserve_energy) {
  expect_all(
      {{with_material(R"("reflectance": 1.7)"), "s.json:4: /materials/white/reflectance: 1.7 is outside 0..1"},
       {with_material(R"("reflectance": -0.1)"), "s.json:4: /materials/white/reflectance: -0.1 is outside 0..1"},
       {with_material(R"("reflectance": 1)"),
        "s.json:4: /materials/white/reflectance: a reflectance of 1 is not below 1: every surface absorbs some light"},
       {with_material(R"("reflectance": [0.5, 0.5, 1.2])"),
        "s.json:4: /materials/white/reflectance/2: 1.2 is outside 0..1"},
       {with_material(R"("reflectance": "grey")"),
        "s.json:4: /materials/white/reflectance: a number or an array of numbers is expected"},
       {with_material(R"("exitance": 3)"), "s.json:4: /materials/white: the key 'reflectance' is missing"},
       {with_material(R"("reflectance": 0, "exitance": -3)"),
        "s.json:4: /materials/white/exitance: -3 is negative: a surface cannot emit less than nothing"},
       {with_material(R"("reflectance": 0, "exitance": 1, "flux": 1)"),
        "s.json:4: /materials/white: exitance and flux exclude each other: give one"},
       {with_material(R"("reflectance": 0, "sides": "back")"),
        "s.json:4: /materials/white/sides: the word 'back' is not known: one of front, both is expected"}});
}

TEST(BadScene, numbers_are_finite) {
  const std::string nan = complaint(with_material(R"("reflectance": NaN)"));
  EXPECT_TRUE(nan.starts_with("s.json:4: JSON syntax error")) << nan;
  const std::string infinite =
      complaint(with_geometry(R"({"polygon": [[0,0,0],[1e999,0,0],[1,1,0]], "material": "white"})"));
  EXPECT_TRUE(infinite.starts_with("s.json:5: number overflow")) << infinite;
}

TEST(BadScene, channels_agree) {
  expect_all(
      {{{R"("channels": [])"}, "s.json:4: /channels: at least 1 elements are expected, not 0"},
       {{R"("channels": ["a", "a"])"},
        "s.json:4: /channels/1: two channels have the name 'a' (upper and lower case are one)"},
       {{R"("channels": ["r", "R"])"},  // a picture would keep one of them
        "s.json:4: /channels/1: two channels have the name 'R' (upper and lower case are one)"},
       {{R"("channels": ["a", "a.error"])"},
        "s.json:4: /channels/1: a channel's name does not end in '.error': pictures keep errors there"},
       {{R"("channels": ["a", "b"], "weights": [1])"}, "s.json:4: /weights: 1 numbers for a scene of 2 channels"},
       {{R"("weights": 0)"}, "s.json:4: /weights: a weight must be positive"},
       {{R"("channels": ["y"])", R"("white": {"reflectance": [0.5, 0.5, 0.5]})"},
        "s.json:5: /materials/white/reflectance: 3 numbers for a scene of 1 channel"},
       {{"", R"("white": {"reflectance": [0.5, 0.5, 0.5]}, "b": {"reflectance": [0.1, 0.2]})"},
        "s.json:4: /materials/b/reflectance: 2 numbers for a scene of 3 channels"}});
  std::string names;
  for (int c = 0; c <= Spectrum::capacity; ++c) names += (c ? ", \"" : "\"") + std::to_string(c) + "\"";
  const std::string said = complaint(Text{"\"channels\": [" + names + "]"});
  EXPECT_TRUE(said.starts_with("s.json:4: /channels: " + std::to_string(Spectrum::capacity + 1) +
                               " channels: this build holds at most"));
}

TEST(BadScene, inline_geometry_is_checked_where_it_stands) {
  expect_all(
      {{with_geometry(""), "s.json:5: /geometry: a scene has at least one surface"},
       {with_geometry(R"({"material": "white"})"),
        "s.json:5: /geometry/0: one of 'file', 'polygon' and 'box' is expected"},
       {with_geometry(R"({"polygon": [[0,0,0],[1,0,0]], "material": "white"})"),
        "s.json:5: /geometry/0/polygon: at least 3 elements are expected, not 2"},
       {with_geometry(R"({"polygon": [[0,0,0],[1,0],[1,1,0]], "material": "white"})"),
        "s.json:5: /geometry/0/polygon/1: 3 elements are expected, not 2"},
       {with_geometry(R"({"polygon": [[0,0,0],[1,0,0],[2,0,0]], "material": "white"})"),
        "s.json:5: /geometry/0/polygon: the outline encloses no area: its corners lie on a line, or it crosses itself"},
       {with_geometry(R"({"polygon": [[0,0,0],[1,0,0],[1,1,0.2],[0,1,0]], "material": "white"})"),
        "s.json:5: /geometry/0/polygon: the polygon is not planar: a corner lies 0.0347 of its diameter out of plane, "
        "at most 1e-06 is allowed"},
       {with_geometry(R"({"polygon": [[0,0,0],[1,0,0],[1,1,0]], "material": "whte"})"),
        "s.json:5: /geometry/0/material: the material 'whte' is not known: did you mean 'white'?"},
       {with_geometry(R"({"polygon": [[0,0,0],[1,0,0],[1,1,0]]})"),
        "s.json:5: /geometry/0: the key 'material' is missing"},
       {with_geometry(R"({"box": {"min": [0,0,0], "max": [1,0,1]}, "material": "white"})"),
        "s.json:5: /geometry/0/box: 'min' must be below 'max' in all three coordinates"},
       {with_geometry(R"({"polygon": [[0,0,0],[1,0,0],[1,1,0]], "material": "white", "transform": {"scale": -1}})"),
        "s.json:5: /geometry/0/transform/scale: -1 is not positive"},
       {with_geometry(R"({"polygon": [[0,0,0],[1,1,0],[1,0,0],[0,2,0]], "material": "white"})"),
        "s.json:5: /geometry/0/polygon: the outline crosses or touches itself: the edges after corners 0 and 2 meet"},
       {with_geometry(R"({"polygon": [[0,0,0],[1e100,0,0],[1e100,1e100,0]], "material": "white"})"),
        "s.json:5: /geometry/0/polygon/1: it lies at (1e+100, 0, 0) m: at most 1e+15 m from 0 along each axis "
        "expected"},
       {with_geometry(R"({"box": {"min": [0,0,0], "max": [1,1,1e100]}, "material": "white"})"),
        "s.json:5: /geometry/0/box/max: it lies at (1, 1, 1e+100) m: at most 1e+15 m from 0 along each axis expected"},
       {with_geometry(R"({"file": "nowhere.obj"})"), "s.json:5: /geometry/0/file: there is no file 'nowhere.obj'"}});
}

TEST(BadScene, cameras_see_something) {
  const auto camera = [](const std::string& body) { return Text{"\"cameras\": [{" + body + "}]"}; };
  expect_all(
      {{camera(R"("eye": [1,1,1], "target": [1,1,1])"),
        "s.json:4: /cameras/0: the camera looks at itself: eye and target are the same point"},
       {camera(R"("eye": [1,1,1e100], "target": [1,1,1])"),
        "s.json:4: /cameras/0/eye: it lies at (1, 1, 1e+100) m: at most 1e+15 m from 0 along each axis expected"},
       {camera(R"("eye": [0,0,3], "target": [0,0,0])"),
        "s.json:4: /cameras/0: the camera looks along its 'up': give it another"},
       {camera(R"("eye": [0,3,0], "target": [0,0,0], "up": [0,2,0])"),
        "s.json:4: /cameras/0/up: the camera looks along its 'up': give it another"},
       {camera(R"("eye": [1,1,1], "target": [0,0,0], "up": [0,0,0])"),
        "s.json:4: /cameras/0/up: the zero vector is no direction"},
       {camera(R"("eye": [1,1,1], "target": [0,0,0], "fov_y_deg": 180)"),
        "s.json:4: /cameras/0/fov_y_deg: an angle between 0 and 180 is expected"},
       {camera(R"("eye": [1,1,1], "target": [0,0,0], "fov_y_deg": 200)"),
        "s.json:4: /cameras/0/fov_y_deg: 200 is outside 0..180"},
       {camera(R"("eye": [1,1,1], "target": [0,0,0], "size": [0, 600])"),
        "s.json:4: /cameras/0/size/0: 0 is outside 1..65536"},
       {camera(R"("eye": [1,1,1], "target": [0,0,0], "size": [800, 70000])"),
        "s.json:4: /cameras/0/size/1: 70000 is outside 1..65536"},
       {camera(R"("eye": [1,1,1], "target": [0,0,0], "size": [80.5, 60])"),
        "s.json:4: /cameras/0/size/0: 80.5 is not a whole number"},
       {camera(R"("name": "a", "eye": [1,1,1], "target": [0,0,0]}, {"name": "a", "eye": [1,1,1], "target": [0,0,0])"),
        "s.json:4: /cameras/1/name: the name 'a' is taken"}});
}

TEST(BadScene, projections_are_known_and_have_what_is_theirs) {
  const auto camera = [](const std::string& body) {
    return Text{R"("cameras": [{"eye": [1,1,1], "target": [0,0,0], )" + body + "}]"};
  };
  expect_all(
      {{camera(R"("projection": "fish-eye")"),
        "s.json:4: /cameras/0/projection: the word 'fish-eye' is not known: did you mean 'fisheye'?"},
       {camera(R"("projection": "fisheye", "fov_y_deg": 90)"),
        "s.json:4: /cameras/0/fov_y_deg: a camera with the projection 'fisheye' has no 'fov_y_deg'"},
       {camera(R"("aperture_radius": 0.1)"),
        "s.json:4: /cameras/0/aperture_radius: a camera with the projection 'pinhole' has no 'aperture_radius'"},
       {camera(R"("projection": "thin-lens")"),
        "s.json:4: /cameras/0: one of 'aperture_radius' and 'f_number' is expected of a thin lens"},
       {camera(R"("projection": "thin-lens", "aperture_radius": 0.1, "f_number": 2)"),
        "s.json:4: /cameras/0: one of 'aperture_radius' and 'f_number' is expected of a thin lens"},
       {camera(R"("projection": "thin-lens", "aperture_radius": 0.1, "sensor_height_mm": 24)"),
        "s.json:4: /cameras/0/sensor_height_mm: only an 'f_number' asks for it"},
       {camera(R"("projection": "thin-lens", "aperture_radius": -0.1)"),
        "s.json:4: /cameras/0/aperture_radius: -0.1 is not positive"},
       {camera(R"("projection": "thin-lens", "f_number": 0)"), "s.json:4: /cameras/0/f_number: 0 is not positive"},
       {camera(R"("projection": "thin-lens", "aperture_radius": 0.1, "focus_distance": 0)"),
        "s.json:4: /cameras/0/focus_distance: 0 is not positive"},
       {camera(R"("projection": "orthographic")"), "s.json:4: /cameras/0: the key 'height' is missing"},
       {camera(R"("projection": "orthographic", "height": 1e100)"),
        "s.json:4: /cameras/0/height: 1e+100 m is out of reach"},
       {camera(R"("projection": "panoramic", "height_deg": 181)"),
        "s.json:4: /cameras/0/height_deg: 181 is outside 0..180"},
       {camera(R"("projection": "panoramic", "width_deg": 0)"),
        "s.json:4: /cameras/0/width_deg: an angle above 0 and up to 360 is expected"},
       {camera(R"("projection": "fisheye", "mapping": "stereographic")"),
        "s.json:4: /cameras/0/mapping: the word 'stereographic' is not known: one of equidistant, equisolid is "
        "expected"}});
}

TEST(BadScene, sensors_measure_somewhere) {
  const auto sensor = [](const std::string& body) { return Text{"\"sensors\": [{\"name\": \"s\", " + body + "}]"}; };
  const std::string n = R"("normal": [0,0,1], )";
  expect_all(
      {{sensor(R"("normal": [0,0,0], "points": [[0,0,0]])"),
        "s.json:4: /sensors/0/normal: the zero vector is no direction"},
       {sensor(R"("normal": [0,0,1])"), "s.json:4: /sensors/0: one of 'grid' and 'points' is expected"},
       {sensor(n + R"("points": [])"), "s.json:4: /sensors/0/points: at least 1 elements are expected, not 0"},
       {sensor(n + R"("points": [[0,0,0]], "exclude_border": 1)"),
        "s.json:4: /sensors/0/exclude_border: only a grid has a border"},
       {sensor(n + R"("quantity": "luminance", "points": [[0,0,0]])"),
        "s.json:4: /sensors/0/quantity: the word 'luminance' is not known: one of irradiance is expected"},
       {sensor(n + R"("grid": {"origin": [0,0,0], "u": [1,0,0], "v": [2,0,0], "spacing": 0.1})"),
        "s.json:4: /sensors/0/grid: u and v are parallel: the grid has no area"},
       {sensor(n + R"("grid": {"origin": [0,0,0], "u": [1,0,0], "v": [0,0,0], "spacing": 0.1})"),
        "s.json:4: /sensors/0/grid/v: a side of a grid has a length"},
       {sensor(n + R"("grid": {"origin": [0,0,0], "u": [1,0,0], "v": [0,1,0]})"),
        "s.json:4: /sensors/0/grid: one of 'spacing' and 'counts' is expected"},
       {sensor(n + R"("grid": {"origin": [0,0,0], "u": [1,0,0], "v": [0,1,0], "spacing": 0})"),
        "s.json:4: /sensors/0/grid/spacing: 0 is not positive"},
       {sensor(n + R"("grid": {"origin": [0,0,0], "u": [1,0,0], "v": [0,1,0], "spacing": 1e-9})"),
        "s.json:4: /sensors/0/grid/spacing: more than 1e+07 points"},
       {sensor(n + R"("grid": {"origin": [0,0,0], "u": [1e6,0,0], "v": [0,1e6,0], "spacing": "en12464"})"),
        "s.json:4: /sensors/0/grid/spacing: more than 1e+07 points"},
       {sensor(n + R"("grid": {"origin": [0,0,0], "u": [1000,0,0], "v": [0,1e-9,0], "spacing": 1e-6})"),
        "s.json:4: /sensors/0/grid/spacing: more than 1e+07 points"},
       {sensor(n + R"("grid": {"origin": [0,0,0], "u": [1e9,0,0], "v": [0,1e9,0], "spacing": 1e-300})"),
        "s.json:4: /sensors/0/grid/spacing: more than 1e+07 points"},
       {sensor(n + R"("grid": {"origin": [0,0,0], "u": [1,0,0], "v": [0,1,0], "counts": [10000, 1001]})"),
        "s.json:4: /sensors/0/grid/counts: more than 1e+07 points"},
       {sensor(n + R"("grid": {"origin": [0,0,0], "u": [1,0,0], "v": [0,1,0], "counts": [0, 3]})"),
        "s.json:4: /sensors/0/grid/counts/0: 0 is outside 1..1000000"},
       {sensor(n + R"("grid": {"origin": [0,0,0], "u": [1,0,0], "v": [0,1,0], "spacing": 0.1}, "exclude_border": 0.5)"),
        "s.json:4: /sensors/0/exclude_border: two borders leave nothing of the grid's shorter side"},
       {sensor(n + R"("points": [[0,0,0]]}, {"name": "s", "normal": [0,0,1], "points": [[0,0,0]])"),
        "s.json:4: /sensors/1/name: the name 's' is taken"}});
}

TEST(BadScene, expectations_are_of_sensors_that_exist) {
  const std::string sensors = "\"sensors\": [{\"name\": \"desk\", \"normal\": [0,0,1], \"points\": [[0,0,0]]}],\n";
  expect_all({{{sensors + R"("expected": [{"sensor": "dsk", "value": 1, "tolerance": 0.1}])"},
               "s.json:5: /expected/0/sensor: the sensor 'dsk' is not known: did you mean 'desk'?"},
              {{sensors + R"("expected": [{"sensor": "desk", "value": 1, "tolerance": 0}])"},
               "s.json:5: /expected/0/tolerance: 0 is not positive"},
              {{sensors + R"("expected": [{"sensor": "desk", "statistic": "median", "value": 1, "tolerance": 1}])"},
               "s.json:5: /expected/0/statistic: the word 'median' is not known: did you mean 'mean'?"}});
}

}  // namespace
}  // namespace interflect::scene
