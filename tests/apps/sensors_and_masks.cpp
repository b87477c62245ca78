#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/apps/factor_tables.h"
#include "tests/apps/geometry_texts.h"
#include "tests/apps/program.h"
#include "tests/support/direct_light.h"

namespace interflect::test {
namespace {

/// The source and the blocker of `direct_light`, and a sensor at each of its points.
std::string shadow_scene(double scale) {
  const auto square = [&](double height) {
    const double a = 0.5 * scale, z = height * scale;
    return core::format("[[%.17g,%.17g,%.17g],[%.17g,%.17g,%.17g],[%.17g,%.17g,%.17g],[%.17g,%.17g,%.17g]]", -a, -a, z,
                        -a, a, z, a, a, z, a, -a, z);
  };
  std::string points;
  for (const DirectLight& row : direct_light)
    points += core::format("%s[%.17g, %.17g, 0]", points.empty() ? "" : ", ", scale * row.x.x(), scale * row.x.y());
  return R"({ "format": "interflect/scene/1", "units": "m", "quantity": "radiometric", "channels": ["y"], "weights": [1],
  "materials": { "grey": { "type": "diffuse", "sides": "front", "reflectance": 0.5 } },
  "geometry": [ { "name": "source", "material": "grey", "polygon": )" +
         square(2) + R"( }, { "name": "blocker", "material": "grey", "polygon": )" + square(1) + R"( } ],
  "sensors": [ { "name": "row", "points": [)" +
         points + R"(], "normal": [0, 0, 1] } ] })";
}

// Through a file and to files, at three scales; what only hides has no column.
TEST(PointViewFactors, of_sensors_in_a_scene_file_are_the_exact_penumbra) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const TemporaryFolder folder;
    const std::string scene = folder.write("shadow.json", shadow_scene(scale));
    const Outcome run = interflect({"view-factors", scene, "-o", folder / "F.csv", "--only-occlude", "blocker"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(contains(run.out, "12 sensor points")) << run.out;
    const std::string text = read_file(folder / "F.sensors.csv");
    EXPECT_TRUE(text.starts_with("sensor,index,j,F,error\n")) << text;
    auto F = entries_of(text);
    for (std::size_t k = 0; k < direct_light.size(); ++k) {
      const TableEntry entry = F[{"row," + std::to_string(k), "0"}];
      EXPECT_NEAR(entry.F, direct_light[k].blocked, entry.error + 1e-12) << k << " at scale " << scale;
      EXPECT_LT(entry.error, 1e-14);
    }
    for (const char* name : {"F.mtx", "F.npz", "G.csv"}) {
      std::vector<std::string> command{"view-factors", scene, "-o", folder / name, "--only-occlude", "blocker"};
      if (name[0] == 'G') command.insert(command.end(), {"--groups", "surface"});
      ASSERT_EQ(interflect(command).status, 0) << name;
    }
    EXPECT_TRUE(contains(read_file(folder / "F.sensors.mtx"), "\n12 1 "));
    EXPECT_TRUE(contains(read_file(folder / "F.npz"), "sensor_F.npy"));
    EXPECT_TRUE(contains(read_file(folder / "G.sensors.csv"), "row,4,source,0.0294437963"));
  }
}

std::string room_with_crate(double scale, bool crate = true) {
  View3dText text;
  add_walls(text, scale * Vec3(0, 0, 0), scale * Vec3(4, 4, 3));
  if (crate) add_crate(text, scale * Vec3(1, 1, 0), scale * Vec3(1, 2, 0.8));
  return text.text();
}

// The floor keeps its 16 m², 2 of which see the crate's bottom alone: F(floor, bottom) = 2/16, F(bottom, floor) = 1,
// and the rows of this closed room sum to 1, however it is cut.
TEST(Masks, and_their_bases_see_each_other_and_rows_sum_to_one) {
  for (const double scale : {1e-3, 1.0}) {
    for (const char* size : {"0", "1"}) {
      const TemporaryFolder folder;
      std::vector<std::string> command{"view-factors", folder.write("room.vs3", room_with_crate(scale)),
                                       "-o",           folder / "F.csv",
                                       "--tolerance",  "1e-4",
                                       "--groups",     "surface",
                                       "--json"};
      if (size[0] != '0')
        command.insert(command.end(), {"--element-size", core::format("%g", std::stod(size) * scale)});
      const Outcome run = interflect(command);
      ASSERT_EQ(run.status, 0) << run.err;
      const auto said = nlohmann::json::parse(run.out);
      EXPECT_NEAR(said.at("row_sum_lowest"), 1, 1e-4);
      EXPECT_NEAR(said.at("row_sum_highest"), 1, 1e-4);
      auto F = entries_of(read_file(folder / "F.csv"));
      EXPECT_NEAR((F[{"floor", "bottom"}].F), 2.0 / 16, 1e-12);
      EXPECT_NEAR((F[{"bottom", "floor"}].F), 1, 1e-12);
      EXPECT_EQ((F[{"bottom", "floor"}].error), 0);
      double floor = 0, bottom = 0;
      for (const auto& [pair, entry] : F) {
        if (pair.first == "floor") floor += entry.F;
        if (pair.first == "bottom") bottom += entry.F;
      }
      EXPECT_NEAR(floor, 1, 1e-4);
      EXPECT_NEAR(bottom, 1, 1e-12) << "it sees its base alone";
    }
  }
}

// Without the mask there is nothing below the crate: 14/16 of the same numbers come from the floor that is left.
TEST(Masks, change_nothing_but_the_area_of_their_base) {
  const TemporaryFolder folder;
  const std::string masked = room_with_crate(1);
  std::string cut = masked;
  cut.replace(cut.find("\nM 12"), 5, "\nN 12");
  std::map<std::pair<std::string, std::string>, TableEntry> F[2];
  for (const int k : {0, 1}) {
    const std::string out = folder / ("F" + std::to_string(k) + ".csv");
    ASSERT_EQ(interflect({"view-factors", folder.write("room" + std::to_string(k) + ".vs3", k == 0 ? masked : cut),
                          "-o", out, "--groups", "surface"})
                  .status,
              0);
    F[k] = entries_of(read_file(out));
  }
  ASSERT_EQ(F[0].size(), F[1].size() + 2);
  for (const auto& [pair, entry] : F[1])
    EXPECT_NEAR((F[0][pair].F), entry.F * (pair.first == "floor" ? 14.0 / 16 : 1), 1e-14)
        << pair.first << " to " << pair.second;
}

TEST(Masks, of_bases_without_view_factors_are_left_out_and_said_to_be) {
  const TemporaryFolder folder;
  const std::string room = folder.write("room.vs3", room_with_crate(1));
  const Outcome run =
      interflect({"view-factors", room, "-o", folder / "F.csv", "--only-occlude", "floor", "--groups", "surface"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(contains(run.err, "1 mask(s) left out")) << run.err;
  EXPECT_FALSE(contains(read_file(folder / "F.csv"), "bottom"));
}

/// Runs to the same file and, if that is to be, stops the first one.
std::string table_after(const TemporaryFolder& folder, const std::string& name, const std::vector<std::string>& command,
                        bool stopped) {
  const auto to = [&](const std::string& out, const std::string& threads = "2") {
    std::vector<std::string> whole = command;
    whole.insert(whole.end(), {"-o", folder / (name + out), "--threads", threads});
    return whole;
  };
  if (stopped) {
    const Outcome first = interflect(to(".h5", "1"), {.interrupt_when = some_tiles});
    EXPECT_EQ(first.status, 1) << first.err;
    EXPECT_TRUE(contains(interflect(to(".h5")).out, "going on with "));
  }
  EXPECT_EQ(interflect(to(".csv")).status, 0);
  return read_file(folder / (name + ".csv"));
}

// docs/view_factor_files.md: a run that goes on ends with the numbers of one that was not stopped.
TEST(ViewFactors, of_sensors_survive_an_interruption) {
  const TemporaryFolder folder;
  const std::vector<std::string> command{"view-factors", shipped_scene("concentric_cubes"), "--element-size", "0.12"};
  EXPECT_EQ(table_after(folder, "F", command, true), table_after(folder, "G", command, false));
  const std::string sensors = read_file(folder / "F.sensors.csv");
  EXPECT_EQ(sensors, read_file(folder / "G.sensors.csv"));
  double sum = 0;
  for (const auto& [pair, entry] : entries_of(sensors)) sum += entry.F;
  EXPECT_NEAR(sum, 1, 1e-10);
}

// What lies between elements is not computed again: the same bits, from the file.
TEST(ViewFactors, of_other_sensors_keep_those_between_elements) {
  const TemporaryFolder folder;
  const auto run_with = [&](const std::string& points) {
    const std::string scene =
        R"({ "format": "interflect/scene/1", "units": "m", "quantity": "radiometric", "channels": ["y"], "weights": [1],
  "materials": { "grey": { "type": "diffuse", "sides": "front", "reflectance": 0.5 } },
  "geometry": [ { "name": "room", "material": "grey", "box": { "min": [0, 0, 0], "max": [2, 1, 1] }, "facing": "inward" } ],
  "sensors": [ { "name": "s", "points": [)" +
        points + R"(], "normal": [0, 0, 1] } ] })";
    return interflect(
        {"view-factors", folder.write("room.json", scene), "-o", folder / "F.csv", "--element-size", "0.09"});
  };
  ASSERT_EQ(run_with("[0.5, 0.5, 0.25]").status, 0);
  const std::string between = read_file(folder / "F.csv");
  const Outcome other = run_with("[1.5, 0.25, 0.5], [0.5, 0.5, 0.25]");
  ASSERT_EQ(other.status, 0) << other.err;
  EXPECT_TRUE(contains(other.out, "F.h5 has those between elements already")) << other.out;
  EXPECT_EQ(read_file(folder / "F.csv"), between);
  std::map<std::string, double> sums;
  for (const auto& [pair, entry] : entries_of(read_file(folder / "F.sensors.csv"))) sums[pair.first] += entry.F;
  EXPECT_EQ(sums.size(), 2u);
  for (const auto& [point, sum] : sums) EXPECT_NEAR(sum, 1, 1e-10) << point;
  EXPECT_TRUE(contains(run_with("[1.5, 0.25, 0.5], [0.5, 0.5, 0.25]").out, "has them already"));
}

TEST(Masks, survive_an_interruption) {
  const TemporaryFolder folder;
  const std::vector<std::string> command{"view-factors", folder.write("room.vs3", room_with_crate(1)), "--element-size",
                                         "0.2"};
  EXPECT_EQ(table_after(folder, "F", command, true), table_after(folder, "G", command, false));
}

TEST(ViewFactors, are_forecast_without_a_file) {
  const TemporaryFolder folder;
  const Outcome said = interflect(
      {"view-factors", folder.write("room.vs3", room_with_crate(1)), "--element-size", "0.5", "--forecast", "--json"});
  ASSERT_EQ(said.status, 0) << said.err;
  const auto forecast = nlohmann::json::parse(said.out);
  const double n = forecast.at("elements");
  EXPECT_GT(n, 100);
  EXPECT_GT(forecast.at("bytes"), 6 * n * n);
  EXPECT_GT(forecast.at("seconds"), 0);
  EXPECT_EQ(folder.files(), 1u);
  const Outcome text = interflect({"view-factors", shipped_scene("cube"), "--forecast"});
  EXPECT_TRUE(contains(text.out, " elements, ")) << text.out;
  EXPECT_TRUE(contains(text.out, " on the disk, about ")) << text.out;
}

}  // namespace
}  // namespace interflect::test
