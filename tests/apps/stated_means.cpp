#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>

#include "tests/apps/program.h"

namespace interflect::test {
namespace {

/// `E_avg(NAME) = VALUE lx, error <= ERROR lx (PERCENT %, estimated)` of what a solve prints: the last such line, since
/// that of a goal comes after the table of its passes.
struct Stated {
  double value, error, percent;
};
std::optional<Stated> stated_of(const std::string& out, const std::string& name) {
  const std::string number = "([0-9.]+(?:e[-+][0-9]+)?)";
  const std::regex line("(?:^|\n)E_avg\\(" + name + "\\) = " + number + " lx, error <= " + number + " lx \\(" + number +
                        " %, estimated\\)(?=\n)");
  std::optional<Stated> found;
  for (std::sregex_iterator at(out.begin(), out.end(), line), end; at != end; ++at)
    found = {std::stod(at->str(1)), std::stod(at->str(2)), std::stod(at->str(3))};
  return found;
}

TEST(StatedMean, is_found_in_what_is_printed) {
  const std::string out =
      "x\nE_avg(desk) = 4.5 lx, error <= 0.1 lx (2.3 %, estimated)\n"
      "E_avg(desk) = 4.1e+02 lx, error <= 1.5 lx (0.37 %, estimated)\nE_avg(hall) = 1 lx, error <= 2 lx (200 %, "
      "guaranteed; estimated 1)\n";
  const auto desk = stated_of(out, "desk");
  ASSERT_TRUE(desk);
  EXPECT_EQ(desk->value, 410);
  EXPECT_EQ(desk->error, 1.5);
  EXPECT_EQ(desk->percent, .37);
  EXPECT_FALSE(stated_of(out, "hall"));
}

/// A room with a lamp that hangs in it, above a board that shades a part of the plane below it.
const std::string room = R"({ "format": "interflect/scene/1", "units": "m", "channels": ["y"], "weights": [1],
  "materials": { "wall": { "type": "diffuse", "reflectance": 0.6 },
                 "board": { "type": "diffuse", "reflectance": 0.3, "sides": "both" },
                 "lamp": { "type": "diffuse", "reflectance": 0.7, "flux": 3000, "sides": "both" } },
  "geometry": [
    { "name": "room", "material": "wall", "box": { "min": [0,0,0], "max": [4,3,2.5] }, "facing": "inward" },
    { "name": "lamp", "material": "lamp", "polygon": [[1.5,1.2,2.2], [1.5,1.8,2.2], [2.7,1.8,2.2], [2.7,1.2,2.2]] },
    { "name": "board", "material": "board", "polygon": [[2.2,0.8,1.4], [3.2,0.8,1.4], [3.2,2.2,1.4], [2.2,2.2,1.4]] } ],
  "sensors": [
    { "name": "plane", "normal": [0, 0, 1],
      "grid": { "origin": [0.5, 0.5, 0.8], "u": [3, 0, 0], "v": [0, 2, 0], "counts": [6, 4] } },
    { "name": "shade", "normal": [0, 0, 1], "points": [[2.7, 1.5, 0.8], [2.9, 1.3, 0.8], [2.6, 1.8, 0.8]] } ] })";

// The bound is one of the value as it is printed, so that it is no less than what the summary has.  Whoever halves the
// elements finds a mean within it; nothing is stated that is so wide that it says nothing.
TEST(StatedMean, has_an_error_that_covers_a_finer_solve) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("room.json", room);
  const auto solved = [&](const std::vector<std::string>& way) {
    std::vector<std::string> command{"solve", scene, "-o", folder / "out", "--no-pictures"};
    command.insert(command.end(), way.begin(), way.end());
    const Outcome solve = interflect(command);
    EXPECT_EQ(solve.status, 0) << solve.err;
    return solve.out;
  };
  const std::string finer = solved({"--form-factors", "analytic", "--order", "2", "--element-size", "0.7"});
  for (const auto& way : std::vector<std::vector<std::string>>{{"--element-size", "1"},
                                                               {"--element-size", "1", "--order", "1"},
                                                               {"--target-error", "1%", "--goal", "shade"}})
    for (const std::string out = solved(way); const char* sensor : {"plane", "shade", "all surfaces"}) {
      const std::optional<Stated> stated = stated_of(out, sensor), better = stated_of(finer, sensor);
      ASSERT_TRUE(stated && better) << out << finer;
      EXPECT_LE(std::abs(stated->value - better->value), stated->error) << sensor << '\n' << out;
      EXPECT_GT(stated->error, 0);
      EXPECT_LT(stated->error, .2 * stated->value) << sensor << '\n' << out;
      EXPECT_NEAR(stated->percent, 100 * stated->error / stated->value, .1 * stated->percent) << out;
      if (way[0] == "--target-error") continue;  // the goal's line is that of its passes
      const auto summary = nlohmann::json::parse(read_file(folder / "out/summary.json"));
      for (const auto& record : summary.at("sensors"))
        if (record.at("name") == sensor) {
          const double mean = record.at("mean"), error = record.at("error");
          EXPECT_NEAR(stated->value, mean, 5e-5 * mean);
          EXPECT_GE(stated->error, error + std::abs(stated->value - mean));
        }
    }
}

}  // namespace
}  // namespace interflect::test
