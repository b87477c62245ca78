#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "core/format.h"
#include "results/image_file.h"
#include "tests/apps/program.h"
#include "validation/statistics.h"

// The command `compare`, as a user has it.
namespace interflect::test {
namespace {

using nlohmann::json;

/// A bulb over a mirror and a floor, under a ceiling.
constexpr const char* bulb_and_mirror = R"({
  "format": "interflect/scene/1", "units": "m", "quantity": "radiometric",
  "materials": {
    "mirror": { "type": "mirror", "reflectance": 0.8 },
    "grey": { "type": "diffuse", "reflectance": 0.5 }
  },
  "lights": [ { "type": "point", "name": "bulb", "position": [0.5, 0.5, 0.5], "flux": 1 } ],
  "geometry": [
    { "name": "mirror", "material": "mirror", "polygon": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]] },
    { "name": "floor", "material": "grey", "polygon": [[1, 0, 0], [2, 0, 0], [2, 1, 0], [1, 1, 0]] },
    { "name": "ceiling", "material": "grey", "polygon": [[0, 0, 1], [0, 1, 1], [2, 1, 1], [2, 0, 1]] }
  ],
  "cameras": [ { "name": "c", "eye": [1.5, 0.5, 0.9], "target": [0.5, 0.5, 0], "fov_y_deg": 60, "size": [4, 4] } ]
})";

constexpr const char* few_samples = "64";  ///< a pixel

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

TEST(Compare, holds_integrators_against_each_other_with_files_and_pictures) {
  const TemporaryFolder folder;
  const Outcome outcome =
      interflect({"compare", shipped_scene("cornell_box"), "--integrators", "path,light,bidirectional", "--target",
                  "10%", "--spp", "2", "-o", folder / "out"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "efficiency") && contains(outcome.out, "path - bidirectional") &&
              contains(outcome.out, "all agree"))
      << outcome.out;
  for (const char* name : {"compare.csv", "compare.json", "path.png", "path.exr", "light.png", "bidirectional.png",
                           "compared_light_path.png", "compared_light_path.exr", "compared_bidirectional_path.png",
                           "compared_bidirectional_light.exr"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / name)) << name;
  const json said = json::parse(read_file(folder / "out/compare.json"));
  EXPECT_TRUE(said.at("agree"));
  ASSERT_EQ(said.at("kinds").size(), 3u);  // surfaces, sensors, pixels
  for (const json& kind : said.at("kinds")) {
    EXPECT_EQ(kind.at("pairs").size(), 3u);
    for (const json& each : kind.at("pairs")) {
      EXPECT_TRUE(each.at("mean_z_judged"));
      EXPECT_LE(std::abs(each.at("mean_z").get<double>()), each.at("mean_z_allowed"));
    }
    for (const json& each : kind.at("integrators")) EXPECT_EQ(each.at("samples_not_finite"), 0);
    for (const json& each : kind.at("integrators")) EXPECT_GT(each.at("efficiency"), 0);
  }
  for (const json& each : said.at("drawn")) EXPECT_TRUE(each.at("missed") == "" && each.at("complete")) << each;
  ASSERT_EQ(said.at("differences").size(), 3u);
  for (const json& each : said.at("differences")) EXPECT_EQ(each.at("samples"), 2) << each;
}

// A lamp that throws its light into a mirror alone, which path tracing meets by chance, once in thousands: its picture
// lacks that by errors that do not know of it, and numbers that were sampled for long enough agree.
TEST(Compare, says_which_pictures_lack_light_that_their_errors_do_not_know) {
  const TemporaryFolder folder;
  const auto scene = folder.write("scene.json", R"({
  "format": "interflect/scene/1", "units": "m", "quantity": "radiometric",
  "materials": {
    "mirror": { "type": "mirror", "reflectance": 0.9 },
    "grey": { "type": "diffuse", "reflectance": 0.5 },
    "lamp": { "type": "diffuse", "reflectance": 0, "exitance": 100 }
  },
  "geometry": [
    { "name": "mirror", "material": "mirror", "polygon": [[0, 0, 0], [0, 2, 0], [0, 2, 2], [0, 0, 2]] },
    { "name": "floor", "material": "grey", "polygon": [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]] },
    { "name": "lamp", "material": "lamp",
      "polygon": [[0.5, 1, 1], [0.5, 1.05, 1], [0.55, 1.05, 1], [0.55, 1, 1]] }
  ],
  "cameras": [ { "name": "c", "eye": [1, 1, 1.9], "target": [1, 1, 0], "up": [0, 1, 0], "fov_y_deg": 50,
                 "size": [96, 96] } ]
})");
  const Outcome outcome = interflect({"compare", scene, "--integrators", "path,bidirectional", "--target", "40%",
                                      "--replications", "0", "--spp", "16", "-o", folder / "out"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "all agree on what was measured; pictures are not judged")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "path.png: light of lamp by way of mirrors")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "compared_bidirectional_path.png: of ")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, " blocks bidirectional is brighter in ")) << outcome.out;
  const json said = json::parse(read_file(folder / "out/compare.json"));
  EXPECT_TRUE(said.at("drawn").at(0).contains("rare_light"));
  EXPECT_FALSE(said.at("drawn").at(1).contains("rare_light"));  // walks from the lamp find it
  const json& differs = said.at("differences").at(0);
  EXPECT_FALSE(differs.at("explained_by_errors"));
  EXPECT_TRUE(contains(differs.at("rare_light"), "path: light of lamp"));
  EXPECT_GT(differs.at("blocks_brighter"), differs.at("blocks_by_chance")) << differs;
  EXPECT_LE(differs.at("blocks_darker"), differs.at("blocks_by_chance")) << differs;
}

TEST(Compare, says_where_a_quadrature_came_to_its_end) {
  const TemporaryFolder folder;
  const auto compare = [&](const char* target) {
    return interflect({"compare", shipped_scene("cube"), "--integrators", "whitted", "--paths", "LE", "--target",
                       target, "--no-pictures", "--replications", "0", "-o", folder / "out"});
  };
  const Outcome far = compare("0.001%"), near = compare("20%");
  EXPECT_TRUE(contains(far.out, "took all the points that its quadrature may have, and may miss --target 0.001 %"))
      << far.out;
  EXPECT_FALSE(contains(near.out, "took all the points")) << near.out;
}

// What the table says is what measuring took, and the rest is told beside it.
TEST(Compare, says_what_its_time_went_to) {
  const TemporaryFolder folder;
  const auto compare = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all{"compare",
                                 shipped_scene("furnace"),
                                 "--integrators",
                                 "path,distributed",
                                 "--target",
                                 "5%",
                                 "--spp",
                                 "2",
                                 "-o",
                                 folder / "out"};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = interflect(all);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return std::make_pair(outcome.out, json::parse(read_file(folder / "out/compare.json")));
  };
  const auto [text, said] = compare({});
  const json& took = said.at("processor_seconds");
  double in_table = 0;
  for (const json& kind : said.at("kinds"))
    for (const json& each : kind.at("integrators")) in_table += each.at("processor_seconds").get<double>();
  EXPECT_NEAR(took.at("measuring"), in_table, 1e-9);
  for (const char* step : {"on_common_paths", "replications", "pictures"}) EXPECT_GT(took.at(step), 0) << step;
  EXPECT_EQ(took.at("solving"), 0);
  EXPECT_GT(said.at("seconds"), 0);
  EXPECT_TRUE(contains(text, "took ") && contains(text, " measuring (the table's column), ") &&
              contains(text, " once more on the paths that pairs have in common, ") &&
              contains(text, " in replications (--replications), ") && contains(text, " for pictures (--spp, "))
      << text;
  const auto [few_text, few] = compare({"--replications", "0", "--no-pictures"});
  EXPECT_EQ(few.at("processor_seconds").at("replications"), 0);
  EXPECT_EQ(few.at("processor_seconds").at("pictures"), 0);
  EXPECT_FALSE(contains(few_text, "--no-pictures") || contains(few_text, "--replications")) << few_text;
}

// In the next run's folder nothing looks like its own that is not; what another command drew there is nobody else's.
TEST(Compare, removes_the_pictures_of_the_comparison_before_and_no_others) {
  const TemporaryFolder folder;
  const auto compare = [&](const char* integrators) {
    const Outcome outcome = interflect({"compare", shipped_scene("furnace"), "--integrators", integrators, "--target",
                                        "20%", "--replications", "0", "--spp", "2", "-o", folder / "out"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  };
  const auto there = [&](const char* name) { return std::filesystem::exists(folder.path() / "out" / name); };
  std::filesystem::create_directory(folder / "out");
  for (const char* name : {"out/controlled.png", "out/distributed.exr", "out/notes.txt"}) folder.write(name, "mine");
  compare("path,light");
  EXPECT_TRUE(there("path.exr") && there("path.png") && there("light.exr") && there("compared_light_path.png"));
  json said = json::parse(read_file(folder / "out/compare.json"));
  EXPECT_EQ(said.at("pictures"), json({"path.exr", "path.png", "light.exr", "light.png", "compared_light_path.png",
                                       "compared_light_path.exr"}));
  for (const char* name : {"notes.txt", "light_but_ASE.png", "light_but_all.png"})  // by someone else's hand
    said.at("pictures").push_back(name);
  for (const char* name : {"out/light_but_ASE.png", "out/light_but_all.png"}) folder.write(name, "mine");
  folder.write("out/compare.json", said.dump());
  compare("path");
  EXPECT_TRUE(there("path.exr") && there("path.png"));
  for (const char* name :
       {"light.exr", "light.png", "light_but_ASE.png", "compared_light_path.png", "compared_light_path.exr"})
    EXPECT_FALSE(there(name)) << name;
  for (const char* name : {"out/controlled.png", "out/distributed.exr", "out/notes.txt", "out/light_but_all.png"})
    EXPECT_EQ(read_file(folder / name), "mine") << name;
}

// What one misses is left out on both sides, and said.
TEST(Compare, compares_on_the_paths_that_both_find) {
  const TemporaryFolder folder;
  const Outcome outcome = interflect({"compare", shipped_scene("materials"), "--integrators", "path,light", "--target",
                                      "20%", "--no-pictures", "--replications", "0", "--json", "-o", folder / "out"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const json said = json::parse(outcome.out);
  for (const json& kind : said.at("kinds")) {
    const json& light = kind.at("integrators").at(1);
    EXPECT_EQ(light.at("missed"), kind.at("measured") == "surfaces" ? "" : "ASE");
    EXPECT_TRUE(contains(kind.at("pairs").at(0).at("paths"), ") and (")) << kind;
    EXPECT_FALSE(kind.at("pairs").at(0).at("mean_z_judged"));
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "path.png"));
}

core::Image picture_of(const std::string& scene, const std::string& integrator, const std::string& paths,
                       const std::string& file) {
  const Outcome outcome = interflect(
      {"trace", scene, "--integrator", integrator, "--paths", paths, "--spp", few_samples, "-o", file, "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return results::read_exr(file);
}

// Path tracing misses what the bulb lights by way of the mirror, light tracing what is seen in the mirror: each draws
// what it finds, and what differs is that of pictures without either.
TEST(Compare, draws_parts_under_names_of_their_own_and_what_differs_on_what_both_find) {
  const TemporaryFolder folder;
  const auto scene = folder.write("scene.json", bulb_and_mirror);
  const Outcome outcome = interflect({"compare", scene, "--integrators", "path,light", "--target", "20%",
                                      "--replications", "0", "--spp", few_samples, "-o", folder / "out"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "light_but_PDSE.png: all that light finds, not such paths as PDSE")) << outcome.out;
  const json said = json::parse(read_file(folder / "out/compare.json"));
  EXPECT_EQ(said.at("pictures"), json({"path_but_PSDE.exr", "path_but_PSDE.png", "light_but_PDSE.exr",
                                       "light_but_PDSE.png", "compared_light_path.png", "compared_light_path.exr"}));
  for (const json& file : said.at("pictures"))
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / file.get<std::string>())) << file;
  EXPECT_EQ(said.at("drawn").at(0).at("missed"), "PSDE");
  EXPECT_EQ(said.at("differences").at(0).at("missed"), "PDSE, PSDE");

  const core::Image whole = picture_of(scene, "light", "AE|L.*(D|G)E", folder / "light.exr");
  EXPECT_EQ(results::read_exr(folder / "out/light_but_PDSE.exr").data, whole.data);
  const core::Image light = picture_of(scene, "light", "PD(.*D)?E", folder / "light.exr"),
                    path = picture_of(scene, "path", "PD(.*D)?E", folder / "path.exr"),
                    differ = results::read_exr(folder / "out/compared_light_path.exr");
  ASSERT_EQ(differ.channels, (std::vector<std::string>{"y", "y.error", "y.z"}));
  const double z_max = validation::sidak_z_max(.01, 4 * 4);
  int lit = 0;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      const double between = double{light.at(x, y, 0)} - double{path.at(x, y, 0)},
                   error = std::hypot(light.at(x, y, 1), path.at(x, y, 1));
      EXPECT_FLOAT_EQ(differ.at(x, y, 0), static_cast<float>(between));
      EXPECT_FLOAT_EQ(differ.at(x, y, 1), static_cast<float>(error));
      EXPECT_LT(std::abs(differ.at(x, y, 2)), z_max) << x << ", " << y;
      lit += path.at(x, y, 0) > 0;
    }
  EXPECT_GT(lit, 0);
}

// A stop while one is drawn once more, for the difference alone: the pictures are there, and what has no difference is
// told.
TEST(Compare, says_what_a_stop_leaves_undrawn) {
  const TemporaryFolder folder;
  const auto scene = folder.write("scene.json", bulb_and_mirror);
  const auto out = folder.path() / "out";
  const Outcome outcome = interflect(
      {"compare", scene, "--integrators", "path,light", "--target", "20%", "--replications", "0", "--spp", "100000",
       "--threads", "1", "-o", out.string()},
      {.interrupt_when = [&](const std::string&) { return std::filesystem::exists(out / "light_but_PDSE.png"); }});
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "stopped: not every picture was drawn")) << outcome.err;
  const json said = json::parse(read_file(out / "compare.json"));
  for (const json& each : said.at("drawn")) EXPECT_EQ(each.at("complete"), true) << each;
  EXPECT_EQ(said.at("differences").at(0).at("refused"), "stopped before it was drawn");
  EXPECT_EQ(said.at("pictures").size(), 4u);
}

// Every ray of a pixel ends at the same lamp: no error, and 1 over its square is no number to be judged by.
TEST(Compare, has_no_efficiency_where_no_error_is_stated) {
  const TemporaryFolder folder;
  const auto scene = folder.write("lamp.json", R"({ "format": "interflect/scene/1", "units": "m",
  "materials": { "lamp": { "type": "diffuse", "reflectance": 0, "exitance": 1 } },
  "geometry": [ { "polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], "material": "lamp", "name": "lamp" } ],
  "cameras": [ { "name": "c", "eye": [0.5, 0.5, 0.5], "target": [0.5, 0.5, 0], "up": [0, 1, 0], "fov_y_deg": 30,
                 "size": [4, 4] } ] })");
  const Outcome outcome =
      interflect({"compare", scene, "--integrators", "path", "--no-pictures", "--json", "-o", folder / "out"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const json said = json::parse(outcome.out);
  for (const json& kind : said.at("kinds")) {
    const json& path = kind.at("integrators").at(0);
    EXPECT_TRUE(path.at("efficiency").is_null()) << path;
    EXPECT_EQ(path.at("no_efficiency"), kind.at("measured") == "pixels" ? "no value has an error" : "all values are 0");
  }
  EXPECT_FALSE(said.contains("not_finite"));
}

// In the furnace H = 1 W/m2 everywhere, whatever the area: of each by itself, and of each held against the other.
TEST(Compare, writes_mean_irradiances_with_their_units) {
  const TemporaryFolder folder;
  const Outcome outcome = interflect({"compare", shipped_scene("furnace"), "--integrators", "path,light", "--target",
                                      "5%", "--no-pictures", "-o", folder / "out"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "mean z")) << outcome.out;
  int by_itself = 0, against = 0;
  for (const auto& row : rows_of(read_file(folder / "out/compare.csv"))) {
    if (row[0] != "surfaces") continue;
    ASSERT_GE(row.size(), 10u);
    EXPECT_EQ(row[2], "W/m2");
    EXPECT_NEAR(std::stod(row[7]), 1, 5 * std::stod(row[8]) + 1e-9) << row[1] << " by " << row[3];
    EXPECT_LT(std::stod(row[8]), .06);
    ++(row[4].empty() ? by_itself : against);
  }
  EXPECT_EQ(by_itself, 2 * 7);  // six sides and all together
  EXPECT_EQ(against, 2 * 7);
}

// More samples lower the noise; the bound is that of elements, made before, and stays.
TEST(Compare, says_where_a_target_is_missed_by_a_bound_that_samples_do_not_lower) {
  const TemporaryFolder folder;
  const auto scene = folder.write("room.json", R"({ "format": "interflect/scene/1", "units": "m",
  "materials": { "lamp": { "type": "diffuse", "reflectance": 0.5, "exitance": 1 },
                 "wall": { "type": "diffuse", "reflectance": 0.5 } },
  "geometry": [
    { "polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], "material": "lamp", "name": "floor" },
    { "polygon": [[0,0,1],[0,1,1],[1,1,1],[1,0,1]], "material": "wall", "name": "ceiling" },
    { "polygon": [[0,0,0],[0,1,0],[0,1,1],[0,0,1]], "material": "wall", "name": "west" } ] })");
  const auto compare = [&](const char* target) {
    const Outcome outcome = interflect({"compare", scene, "--integrators", "path,two-pass", "--target", target,
                                        "--replications", "0", "-o", folder / "out"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const json kind = json::parse(read_file(folder / "out/compare.json")).at("kinds").at(0);
    EXPECT_EQ(kind.at("integrators").at(0).at("misses_target_by_bound"), false);  // path tracing has no bound
    return std::make_pair(outcome.out, kind.at("integrators").at(1));
  };
  const auto [few_said, few] = compare("20%");
  const auto [many_said, many] = compare("0.25%");
  EXPECT_LT(many.at("relative_noise"), .5 * few.at("relative_noise").get<double>());
  EXPECT_NEAR(many.at("relative_bound").get<double>() / few.at("relative_bound").get<double>(), 1, .1);
  const double bound = many.at("relative_bound");
  ASSERT_TRUE(.0025 < bound && bound < .2) << bound;
  EXPECT_EQ(few.at("misses_target_by_bound"), false);
  EXPECT_EQ(many.at("misses_target_by_bound"), true);
  const std::string line = "two-pass misses --target 0.25 % of surfaces by its error bound";
  EXPECT_TRUE(contains(many_said, line) && contains(many_said, "more samples do not lower")) << many_said;
  EXPECT_FALSE(contains(few_said, "misses --target")) << few_said;
}

TEST(Compare, lists_who_finds_nothing_that_is_asked_for) {
  const TemporaryFolder folder;
  const auto scene = folder.write("scene.json", bulb_and_mirror);
  const auto compare = [&](const char* paths) {
    return interflect({"compare", scene, "--integrators", "path,light", "--target", "20%", "--paths", paths,
                       "--no-pictures", "-o", folder / "out"});
  };
  const Outcome mirrored = compare("PSE");
  EXPECT_EQ(mirrored.status, 0) << mirrored.err;
  EXPECT_TRUE(contains(mirrored.out, "path does not answer surfaces: finds none of these paths, PSE")) << mirrored.out;
  // The point's own picture is nothing that one would miss.
  const Outcome direct = compare("PDE|PE");
  EXPECT_EQ(direct.status, 0) << direct.err;
  const json said = json::parse(read_file(folder / "out/compare.json"));
  for (const json& kind : said.at("kinds"))
    for (const json& each : kind.at("integrators")) EXPECT_EQ(each.at("missed"), "") << kind;
}

// What path tracing would miss of a point of light, a picture is refused for, unless it is left out.
TEST(Trace, refuses_what_it_would_miss_and_draws_what_is_left) {
  const TemporaryFolder folder;
  const auto scene = folder.write("scene.json", bulb_and_mirror);
  const auto trace = [&](std::vector<std::string> more) {
    std::vector<std::string> all{"trace", scene, "--spp", "16", "-o", folder / "picture.exr"};
    all.insert(all.end(), more.begin(), more.end());
    return interflect(all);
  };
  const Outcome refused = trace({});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(contains(refused.err, "(from a point or spot, by a mirror, pane or smooth glass, by a diffuse surface)"))
      << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "picture.exr"));
  const std::string hint = "--paths '";
  const std::size_t begin = refused.err.find(hint);
  ASSERT_NE(begin, std::string::npos) << refused.err;
  const std::size_t first = begin + hint.size(), end = refused.err.find('\'', first);
  const Outcome left = trace({"--paths", refused.err.substr(first, end - first)});
  EXPECT_EQ(left.status, 0) << left.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "picture.exr"));
}

TEST(Compare, takes_classes_of_paths_and_says_where_they_are_wrong) {
  const TemporaryFolder folder;
  const auto compare = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all{"compare", shipped_scene("furnace"), "-o", folder / "out", "--no-pictures"};
    all.insert(all.end(), more.begin(), more.end());
    return interflect(all);
  };
  EXPECT_EQ(compare({"--paths", "LDE", "--target", "5%", "--quiet"}).status, 0);
  const Outcome wrong = compare({"--paths", "LXE"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_TRUE(contains(wrong.err, "paths 'LXE', at character 2: a letter of LAPFBDGSE.()|*+? expected")) << wrong.err;
  EXPECT_EQ(compare({"--integrators", "path,magic"}).status, 2);
  EXPECT_EQ(compare({"--camera", "no such"}).status, 2);
  EXPECT_EQ(compare({"--target", "0"}).status, 2);
}

TEST(Validate, has_its_reference_by_any_integrator) {
  const TemporaryFolder folder;
  const Outcome outcome =
      interflect({"validate", shipped_scene("furnace"), "--integrator", "bidirectional", "--accuracy", "5%",
                  "--no-pictures", "--element-size", "0.5", "--json", "-o", folder / "out"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(json::parse(read_file(folder / "out/validation.json")).at("integrator"), "bidirectional");
}

// One that finds less than radiosity does would say that radiosity is wrong: it is refused before the work.
TEST(Validate, has_no_reference_that_finds_less_than_radiosity) {
  for (const char* integrator : {"whitted", "distributed"}) {
    const TemporaryFolder folder;
    const Outcome outcome =
        interflect({"validate", shipped_scene("furnace"), "--integrator", integrator, "-o", folder / "out"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_TRUE(contains(outcome.err, core::format("integrator '%s': an unbiased one expected that finds all that "
                                                   "radiosity does, A(D|S)*E, also ADE",
                                                   integrator)))
        << outcome.err;
    EXPECT_EQ(folder.files(), 0u);
  }
}

}  // namespace
}  // namespace interflect::test
