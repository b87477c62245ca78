#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/apps/program.h"

// The command `compare`, as a user has it.
namespace interflect::test {
namespace {

using nlohmann::json;

TEST(Compare, holds_integrators_against_each_other_with_files_and_pictures) {
  const TemporaryFolder folder;
  const Outcome outcome =
      interflect({"compare", shipped_scene("cornell_box"), "--integrators", "path,light,bidirectional", "--target",
                  "5%", "--spp", "2", "-o", folder / "out"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "efficiency") && contains(outcome.out, "path - bidirectional") &&
              contains(outcome.out, "all agree"))
      << outcome.out;
  for (const char* name : {"compare.csv", "compare.json", "path.png", "path.exr", "light.png", "bidirectional.png",
                           "compared_light_path.png", "compared_bidirectional_path.png"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / name)) << name;
  const json said = json::parse(read_file(folder / "out/compare.json"));
  EXPECT_TRUE(said.at("agree"));
  ASSERT_EQ(said.at("kinds").size(), 3u);  // surfaces, sensors, pixels
  for (const json& kind : said.at("kinds")) {
    EXPECT_EQ(kind.at("pairs").size(), 3u);
    for (const json& each : kind.at("integrators")) EXPECT_GT(each.at("efficiency"), 0);
  }
}

// What one misses is left out on both sides, and said.
TEST(Compare, compares_on_the_paths_that_both_find) {
  const TemporaryFolder folder;
  const Outcome outcome = interflect({"compare", shipped_scene("materials"), "--integrators", "path,light", "--target",
                                      "20%", "--no-pictures", "--json", "-o", folder / "out"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const json said = json::parse(outcome.out);
  for (const json& kind : said.at("kinds")) {
    const json& light = kind.at("integrators").at(1);
    EXPECT_EQ(light.at("missed"), kind.at("measured") == "surfaces" ? "" : "ASE");
    EXPECT_TRUE(contains(kind.at("pairs").at(0).at("paths"), ") and (")) << kind;
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "path.png"));
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
  EXPECT_TRUE(contains(wrong.err, "paths 'LXE', at character 2: a letter of LAPFDGSE.()|*+? expected")) << wrong.err;
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

}  // namespace
}  // namespace interflect::test
