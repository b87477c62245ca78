#include <gtest/gtest.h>

#include <algorithm>

#include "tests/apps/program.h"

namespace interflect::test {
namespace {

/// Every bad input: exit status 2, one line on standard error that has `expected` in it, nothing on standard output, no
/// files.
void expect_refused(const std::vector<std::string>& arguments, const std::string& expected) {
  const Outcome outcome = interflect(arguments);
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(expected), std::string::npos) << outcome.err << "\nexpected in it: " << expected;
  EXPECT_EQ(outcome.out, "");
}

void expect_scene_refused(const std::string& text, const std::string& expected) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.json", text), out = folder / "out";
  expect_refused({"solve", scene, "-o", out}, expected);
  EXPECT_FALSE(std::filesystem::exists(out)) << "a refused scene leaves nothing behind";
}

std::string scene_with(const std::string& materials, const std::string& geometry, const std::string& rest = "") {
  return R"({ "format": "interflect/scene/1", "units": "m",
  "materials": { )" +
         materials + R"( },
  "geometry": [ )" +
         geometry + " ]" + rest + " }";
}

const std::string grey = R"("grey": { "type": "diffuse", "reflectance": 0.5, "exitance": 1 })";
const std::string square = R"({ "polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], "material": "grey", "name": "square" })";

TEST(BadInput, a_missing_file) { expect_refused({"solve", "/nowhere/scene.json", "-o", "x"}, "/nowhere/scene.json"); }

TEST(BadInput, no_such_command_or_option) {
  expect_refused({"paint"}, "command line");
  expect_refused({"solve", shipped_scene("cube"), "-o", "x", "--element-sise", "1"}, "command line");
  expect_refused({"solve", shipped_scene("cube")}, "--out");
  expect_refused({"solve", shipped_scene("cube"), "-o", "x", "--element-size", "-1"}, "--element-size");
  expect_refused({"solve", shipped_scene("cube"), "-o", "x", "--solver", "magic"}, "gauss-seidel");
  expect_refused({"solve", shipped_scene("cube"), "-o", "x", "--closure", "magic"}, "least-squares");
  expect_refused({"solve", shipped_scene("cube"), "-o", "x", "--drop-below", "2"}, "--drop-below");
  expect_refused({"solve", shipped_scene("cube"), "-o", "x", "--tolerance", "1"}, "--tolerance");
  for (const char* seed : {"-1", "18446744073709551616", "1e3", "seven"})
    expect_refused({"solve", shipped_scene("cube"), "-o", "x", "--seed", seed}, "--seed");
}

TEST(BadInput, goals_that_are_none) {
  const std::string scene = shipped_scene("cube");
  expect_refused({"solve", scene, "-o", "x", "--goal", "nowhere"}, "one of middle_down, middle_up, camera:inside, or");
  expect_refused({"solve", scene, "-o", "x", "--goal", "camera:nowhere"}, "--goal camera:nowhere");
  expect_refused({"solve", scene, "-o", "x", "--target-error", "2"}, "--target-error");
  expect_refused({"solve", scene, "-o", "x", "--goal", "floor", "--form-factors", "duffy", "--target-error", "1%"},
                 "by analytic ones, which have no noise: --form-factors analytic");
  expect_refused({"solve", scene, "-o", "x", "--goal", "floor", "--order", "3"}, "order 1 or 2");
  expect_refused({"solve", scene, "-o", "x", "--goal", "floor", "--order", "0"}, "order 1 or 2");
  expect_refused({"render", scene, "-o", "x.png", "--camera", "nowhere"}, "--camera nowhere");
}

TEST(BadInput, settings_that_the_method_has_not) {
  const std::string scene = shipped_scene("cube");
  expect_refused({"view-factors", scene, "-o", "F.csv", "--samples", "1e4"},
                 "form factors by analytic do not heed it: --form-factors area-to-area, hemisphere-rays, global-lines");
  expect_refused({"solve", scene, "-o", "x", "--form-factors", "hybrid", "--visibility-rays", "64"},
                 "form factors by hybrid do not heed it: --form-factors gauss-lambert, duffy");
  expect_refused({"exchange", scene, "-o", "x", "--resolution", "64"}, "--resolution");
  expect_refused({"solve", scene, "-o", "x", "--order", "1", "--visibility-rays", "64"}, "--visibility-rays");
  expect_refused({"solve", scene, "-o", "x", "--samples", "100"}, "gauss-lambert");
}

TEST(BadInput, settings_that_the_solver_has_not) {
  const std::string scene = shipped_scene("cube"), rays = "regular-stochastic-jacobi";
  expect_refused({"solve", scene, "-o", "x", "--noise", "2%"},
                 "--noise: automatic does not heed it: --solver stochastic-jacobi, regular-stochastic-jacobi, ");
  expect_refused({"validate", scene, "-o", "x", "--solver", "jacobi", "--sequence", "sobol"},
                 "--sequence: jacobi does not heed it: --solver stochastic-jacobi, ");
  expect_refused({"solve", scene, "-o", "x", "--solver", "gmres", "--relaxation", "1.1"},
                 "--relaxation: gmres does not heed it: --solver over-relaxation;");
  expect_refused({"solve", scene, "-o", "x", "--unshot", "1%"}, "--unshot: automatic does not heed it: ");
  expect_refused({"shoot", scene, "-o", "x", "--solver", "southwell", "--overshoot", "0.5"},
                 "--overshoot: southwell does not heed it: --solver progressive;");
  expect_refused({"solve", scene, "-o", "x", "--solver", rays, "--solver-tolerance", "1e-3"},
                 "does not heed it: --solver automatic, conjugate-gradients, ");
  for (const auto& [name, value] :
       std::vector<std::pair<const char*, const char*>>{{"--visibility-error", "5%"}, {"--form-factors", "analytic"}})
    expect_refused({"solve", scene, "-o", "x", "--solver", rays, name, value},
                   std::string(name) + ": " + rays + " works by rays, without form factors, and does not heed it: ");
  expect_refused({"compare-solvers", scene, "-o", "x", "--solvers", "jacobi", "gmres", "--noise", "5%"},
                 "--noise: none of jacobi, gmres heeds it: --solvers stochastic-jacobi, ");
}

TEST(BadInput, settings_that_view_factors_of_a_file_do_not_heed) {
  const std::vector<std::pair<const char*, const char*>> settings{{"--form-factors", "analytic"},
                                                                  {"--quadrature-tolerance", "1e-4"},
                                                                  {"--visibility-rays", "64"},
                                                                  {"--visibility-error", "5%"}};
  for (const auto& [name, value] : settings)
    for (const char* command : {"solve", "validate", "render"})
      expect_refused({command, shipped_scene("cube"), "-o", "x", "--factors", "F.h5", name, value},
                     std::string(name) + ": the view factors of a file do not heed it");
}

// A variable that is not set leaves "", which is none.
TEST(BadInput, names_that_are_empty) {
  const std::string scene = shipped_scene("cube");
  for (const char* name : {"--factors", "--goal"})
    expect_refused({"solve", scene, "-o", "x", name, ""}, std::string(name) + ": the name of a");
  expect_refused({"render", scene, "-o", "x.png", "--camera", ""}, "--camera: the name of a camera is expected");
  expect_refused({"trace", scene, "-o", "x.png", "--estimates", ""}, "--estimates: the name of a folder is expected");
  expect_refused({"trace", scene, "-o", "x.png", "--paths", ""},
                 "--paths: a class of paths, such as L.*E, is expected");
  expect_refused({"solve", "", "-o", "x"}, "SCENE: the name of a scene file is expected");
  expect_refused({"solve", scene, "-o", ""}, "--out: the name of a folder is expected");
}

TEST(BadInput, numbers_that_are_not_whole) {
  for (const char* samples : {"1.5", "0", "-1", "1e4", "16777217", ""})
    expect_refused({"trace", shipped_scene("cube"), "-o", "x.png", "--spp", samples},
                   "--spp: '" + std::string(samples) + "' is not a whole number from 1 to 16777216");
}

TEST(BadInput, percents_out_of_a_range_that_is_told_in_percents) {
  const std::string scene = shipped_scene("cube");
  expect_refused({"solve", scene, "-o", "x", "--visibility-error", "60%"}, "'60%' is not from 0.1 to 50 %");
  expect_refused({"solve", scene, "-o", "x", "--noise", "0.6"}, "'0.6' is not from 0.0001 to 50 %");
  expect_refused({"solve", scene, "-o", "x", "--unshot", "200%"}, "'200%' is not from 0 to 100 %");
  expect_refused({"shoot", scene, "-o", "x", "--unshot", "0"}, "'0' is not above 0 and below 100 %");
  expect_refused({"validate", scene, "-o", "x", "--accuracy", "100%"}, "'100%' is not above 0 and below 100 %");
  expect_refused({"solve", scene, "-o", "x", "--target-error", "1 mm"}, "'1 mm' is not a part such as 1% or 0.01");
}

TEST(BadInput, numbers_that_are_none_or_out_of_range) {
  const std::string scene = shipped_scene("cube");
  for (const char* tolerance : {"nan", "-1", "0", "1e-3x"})
    expect_refused({"view-factors", scene, "-o", "F.csv", "--tolerance", tolerance}, "--tolerance");
  expect_refused({"solve", scene, "-o", "x", "--quadrature-tolerance", "nan"}, "--quadrature-tolerance");
  expect_refused({"exchange", scene, "-o", "x", "--environment", "nan"}, "--environment");
  expect_refused({"view-factors", scene, "-o", "F.csv", "--samples", "-5"}, "--samples");
  for (const char* samples : {"1.5", "1e16", "many"})
    expect_refused({"view-factors", scene, "-o", "F.csv", "--form-factors", "global-lines", "--samples", samples},
                   "is not a whole number");
}

TEST(BadInput, malformed_and_truncated_json) {
  expect_scene_refused("{ \"format\": ", "scene.json:1");
  expect_scene_refused("", "scene.json");
  expect_scene_refused(std::string("\xFF\xFE{\0}\0", 6), "UTF-16");
}

TEST(BadInput, an_unknown_key_names_the_nearest_known_one) {
  expect_scene_refused(scene_with(R"("grey": { "type": "diffuse", "reflektance": 0.5 })", square), "reflectance");
}

TEST(BadInput, an_unmapped_material) {
  const TemporaryFolder folder;
  folder.write("room.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl Wall\nf 1 2 3\n");
  const std::string scene = folder.write("scene.json", scene_with(grey, R"({ "file": "room.obj", "materials": {} })"));
  expect_refused({"info", scene}, "Wall");
}

TEST(BadInput, reflectance_of_one_or_more) {
  expect_scene_refused(scene_with(R"("grey": { "type": "diffuse", "reflectance": 1 })", square),
                       "/materials/grey/reflectance");
}

TEST(BadInput, coordinates_that_are_not_finite) {
  expect_scene_refused(scene_with(grey, R"({ "polygon": [[0,0,0],[1,0,1e999],[1,1,0]], "material": "grey" })"),
                       "scene.json:3");
  expect_scene_refused(scene_with(grey, R"({ "polygon": [[0,0,0],[1,0,NaN],[1,1,0]], "material": "grey" })"),
                       "scene.json:3");
}

TEST(BadInput, an_empty_mesh) {
  const TemporaryFolder folder;
  folder.write("empty.obj", "");
  expect_refused(
      {"check", folder.write("scene.json", scene_with(grey, R"({ "file": "empty.obj", "unmapped": "grey" })"))},
      "empty.obj");
}

TEST(BadInput, polygons_without_area_or_out_of_plane) {
  expect_scene_refused(scene_with(grey, R"({ "polygon": [[0,0,0],[1,0,0],[2,0,0]], "material": "grey" })"),
                       "/geometry/0");
  expect_scene_refused(scene_with(grey, R"({ "polygon": [[0,0,0],[1,0,0],[1,1,0.1],[0,1,0]], "material": "grey" })"),
                       "planar");
}

TEST(BadInput, indices_out_of_range) {
  const TemporaryFolder folder;
  folder.write("room.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  expect_refused(
      {"info", folder.write("scene.json", scene_with(grey, R"({ "file": "room.obj", "unmapped": "grey" })"))},
      "room.obj");
}

TEST(BadInput, a_camera_that_looks_at_itself) {
  expect_scene_refused(
      scene_with(
          grey, square,
          R"(, "cameras": [ { "name": "c", "eye": [1,1,1], "target": [1,1,1], "fov_y_deg": 50, "size": [8,8] } ])"),
      "/cameras/0");
}

TEST(BadInput, cameras_that_a_method_cannot_see_through) {
  const TemporaryFolder folder;
  const std::string scene = folder.write(
      "scene.json",
      scene_with(grey, square,
                 R"(, "cameras": [ { "name": "slr", "eye": [1,1,1], "target": [0,0,0], "projection": "thin-lens",
                                     "f_number": 2, "size": [8,8] } ])"));
  const std::string said = "camera 'slr': radiosity knows no thin lens; interflect trace does";
  expect_refused({"render", scene, "-o", folder / "x.png"}, said);
  expect_refused({"solve", scene, "-o", folder / "x", "--goal", "camera:slr"}, said);
  EXPECT_FALSE(std::filesystem::exists(folder / "x.png") || std::filesystem::exists(folder / "x"));
}

TEST(BadInput, filters_and_sequences_of_pictures) {
  const TemporaryFolder folder;
  const auto trace = [&](const std::string& option, const std::string& value) {
    return std::vector<std::string>{
        "trace", shipped_scene("cornell_box"), "-o", folder / "x.exr", "--spp", "40", option, value};
  };
  expect_refused(trace("--sequence", "sobol"), "a multiple of 16 a pixel expected, not 40");
  expect_refused(trace("--sequence", "sobel"), "sobol-owen");
  expect_refused(trace("--filter", "bocks"), "gaussian");
}

TEST(BadInput, an_unknown_camera_names_those_known) {
  const TemporaryFolder folder;
  expect_refused({"trace", shipped_scene("cornell_box"), "--camera", "roof", "-o", folder / "x.exr"}, "front");
}

TEST(BadInput, a_picture_format_that_is_not_known) {
  const TemporaryFolder folder;
  expect_refused({"trace", shipped_scene("cornell_box"), "-o", folder / "x.jpg"}, ".exr");
}

TEST(BadInput, a_folder_that_cannot_be_written) {
  expect_refused({"solve", shipped_scene("cube"), "-o", "/proc/interflect"}, "/proc/interflect");
  const TemporaryFolder folder;
  expect_refused({"solve", shipped_scene("cube"), "-o", folder.write("file", "") / "out"}, "file");
}

TEST(BadInput, more_memory_than_allowed) {
  const TemporaryFolder folder;
  expect_refused({"solve", shipped_scene("office"), "-o", folder / "out", "--element-size", "0.01"}, "--element-size");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(BadInput, no_memory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take more address space than the limit";
#endif
  const TemporaryFolder folder;
  const Outcome outcome =
      interflect({"solve", shipped_scene("office"), "-o", folder / "out", "--element-size", "0.1", "--max-memory",
                  "20GB", "--threads", "2", "--quiet"},  // stacks take address space
                 {.memory_limit_kb = 1'500'000});
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("memory"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace interflect::test
