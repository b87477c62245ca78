#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/apps/program.h"

namespace interflect::test {
namespace {

/// The program's progress has told of at least 1 % of a stage.  Stages go round after round over all pixels or
/// measurements, so that each has a hundredth of its samples then, but for a factor of two.
std::function<bool(const std::string&)> part_of(const std::string& stage) {
  return [pattern = std::regex(stage + ": [1-9][0-9]* %")](const std::string& err) {
    return std::regex_search(err, pattern);
  };
}

nlohmann::json json_of(const std::filesystem::path& file) { return nlohmann::json::parse(read_file(file)); }

// A finished picture needs its checkpoint no more, unless it is to grow: then it does, to the bytes of one that had all at
// once.
TEST(Interrupted, a_finished_picture_leaves_a_checkpoint_where_it_is_to_grow) {
  const TemporaryFolder folder;
  const auto trace = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"trace", shipped_scene("furnace"), "-o", folder / (name + ".exr")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return interflect(arguments);
  };
  ASSERT_EQ(trace("whole", {"--spp", "3"}).status, 0);
  const Outcome kept = trace("grown", {"--spp", "1", "--keep-checkpoint"});
  ASSERT_EQ(kept.status, 0) << kept.err;
  EXPECT_TRUE(contains(kept.out, "--resume goes on from")) << kept.out;
  ASSERT_TRUE(std::filesystem::exists(folder / "grown.checkpoint.h5"));
  const Outcome grown = trace("grown", {"--spp", "3", "--resume"});
  ASSERT_EQ(grown.status, 0) << grown.err;
  EXPECT_TRUE(read_file(folder / "grown.exr") == read_file(folder / "whole.exr"));
  EXPECT_FALSE(std::filesystem::exists(folder / "grown.checkpoint.h5"));
  const Outcome again = trace("grown", {"--spp", "6", "--resume"});
  EXPECT_EQ(again.status, 2);
  EXPECT_TRUE(contains(again.err, "there is no such checkpoint") && contains(again.err, "--keep-checkpoint"))
      << again.err;
}

// Pictures of a comparison grow as those of `trace`: the one at work is kept with what it has.
TEST(Interrupted, a_comparison_keeps_the_picture_that_it_is_at) {
  const TemporaryFolder folder;
  const Outcome compare = interflect({"compare", shipped_scene("furnace"), "--integrators", "path,light", "--target",
                                      "20%", "--replications", "0", "--spp", "400", "-o", folder / "out"},
                                     {.interrupt_when = part_of("rendering inside")});
  EXPECT_EQ(compare.status, 1) << compare.err;
  EXPECT_TRUE(contains(compare.err, "stopped: the picture by path has ")) << compare.err;
  EXPECT_TRUE(contains(compare.err, "stopped: not every picture was drawn")) << compare.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "out/path.exr") && std::filesystem::exists(folder / "out/path.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/light.exr"));
  EXPECT_EQ(json_of(folder / "out/compare.json").at("stopped"), true);
}

TEST(Interrupted, a_picture_is_kept_with_the_samples_so_far) {
  const TemporaryFolder folder;
  const Outcome trace = interflect(
      {"trace", shipped_scene("cornell_box"), "--spp", "2000", "--threads", "2", "-o", folder / "c.exr", "--json"},
      {.interrupt_when = part_of("rendering front")});
  EXPECT_EQ(trace.status, 1) << trace.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "c.exr") && std::filesystem::exists(folder / "c.png"));
  const auto said = nlohmann::json::parse(trace.out);
  EXPECT_EQ(said.at("stopped"), true);
  EXPECT_GT(said.at("samples"), 0);
  EXPECT_LT(said.at("samples"), 2000);
}

// Whatever the threads, and with other sample counts on the way: the bytes of a run that nothing stopped.
TEST(Interrupted, a_picture_goes_on_to_the_same_bytes) {
  const TemporaryFolder folder;
  const auto trace = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"trace", shipped_scene("cornell_box"), "-o", folder / (name + ".exr")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return interflect(arguments);
  };
  const Outcome whole = trace("whole", {"--spp", "64", "--threads", "2"});
  EXPECT_EQ(whole.status, 0) << whole.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "whole.checkpoint.h5"));
  const Outcome stopped = trace("parts", {"--spp", "100000", "--threads", "2", "--max-time", "1s"});
  EXPECT_EQ(stopped.status, 1) << stopped.err;
  ASSERT_TRUE(std::filesystem::exists(folder / "parts.checkpoint.h5")) << stopped.err;
  EXPECT_TRUE(contains(stopped.out + stopped.err, "--resume goes on from")) << stopped.out << stopped.err;
  const Outcome gone_on = trace("parts", {"--spp", "64", "--threads", "8", "--resume", "--keep-checkpoint"});
  EXPECT_EQ(gone_on.status, 0) << gone_on.err;
  for (const char* extension : {".exr", ".png"})
    EXPECT_TRUE(read_file(folder / ("parts" + std::string(extension))) ==
                read_file(folder / ("whole" + std::string(extension))))
        << extension;

  const Outcome fewer = trace("parts", {"--spp", "32", "--resume"});
  EXPECT_EQ(fewer.status, 2);
  EXPECT_TRUE(contains(fewer.err, "64 samples a pixel already, more than 32")) << fewer.err;
  const Outcome other = interflect({"trace", shipped_scene("cube"), "-o", folder / "parts.exr", "--resume"});
  EXPECT_EQ(other.status, 2);
  EXPECT_TRUE(contains(other.err, "parts.checkpoint.h5: this checkpoint is of another scene")) << other.err;
  for (const std::vector<std::string>& settings :
       {std::vector<std::string>{"--filter", "gaussian"}, {"--sequence", "sobol"}, {"--seed", "2"}}) {
    std::vector<std::string> arguments = {"--resume", "--spp", "64"};
    arguments.insert(arguments.end(), settings.begin(), settings.end());
    const Outcome refused = trace("parts", arguments);
    EXPECT_EQ(refused.status, 2);
    EXPECT_TRUE(contains(refused.err, "of other settings")) << refused.err;
  }
  const Outcome nothing = trace("nowhere", {"--resume"});
  EXPECT_EQ(nothing.status, 2);
  EXPECT_TRUE(contains(nothing.err, "there is no such checkpoint")) << nothing.err;
}

/// A lamp over a floor, seen in few pixels.
constexpr const char* lamp_over_a_floor = R"({
  "format": "interflect/scene/1", "units": "m", "quantity": "radiometric",
  "materials": {
    "grey": { "type": "diffuse", "reflectance": 0.5 },
    "glow": { "type": "diffuse", "reflectance": 0.2, "exitance": 5 }
  },
  "geometry": [
    { "name": "floor", "material": "grey", "polygon": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]] },
    { "name": "lamp", "material": "glow", "polygon": [[-1, -1, 2], [-1, 1, 2], [1, 1, 2], [1, -1, 2]] }
  ],
  "cameras": [ { "name": "c", "eye": [0, -0.9, 1], "target": [0, 0.1, 0], "fov_y_deg": 60, "size": [24, 20] } ]
})";

// So by every integrator, on the paths that it finds; and to a target each ends before all samples are there.
TEST(Interrupted, pictures_by_any_integrator_go_on_and_end_at_a_target) {
  for (const std::string integrator : {"bidirectional", "light", "distributed", "whitted"}) {
    const TemporaryFolder folder;
    const auto scene = folder.write("scene.json", lamp_over_a_floor);
    const auto trace = [&](const std::string& name, const std::vector<std::string>& more) {
      std::vector<std::string> arguments = {"trace", scene, "-o", folder / (name + ".exr")};
      for (const std::string& each : {std::string("--integrator"), integrator, std::string("--paths"),
                                      std::string("L(D|G)?S*E"), std::string("--json")})
        arguments.push_back(each);
      arguments.insert(arguments.end(), more.begin(), more.end());
      return interflect(arguments);
    };
    const Outcome stopped = trace("parts", {"--spp", "16000000", "--threads", "2", "--max-time", "1s"});
    EXPECT_EQ(stopped.status, 1) << integrator << stopped.err;
    const auto said = nlohmann::json::parse(stopped.out);
    EXPECT_EQ(said.at("stopped"), true) << integrator;
    ASSERT_TRUE(std::filesystem::exists(folder / "parts.checkpoint.h5")) << integrator << stopped.err;
    const auto done = said.at("samples").get<int>();
    EXPECT_GT(done, 0) << integrator;
    const std::string whole_count = std::to_string((done / 16 + 2) * 16);
    const Outcome gone_on = trace("parts", {"--spp", whole_count, "--threads", "8", "--resume"}),
                  whole = trace("whole", {"--spp", whole_count, "--threads", "2"});
    EXPECT_EQ(gone_on.status, 0) << integrator << gone_on.err;
    EXPECT_EQ(whole.status, 0) << integrator << whole.err;
    EXPECT_TRUE(read_file(folder / "parts.exr") == read_file(folder / "whole.exr")) << integrator;
    const Outcome to_target = trace("good", {"--spp", "16000000", "--threads", "2", "--target", "20%"});
    EXPECT_EQ(to_target.status, 0) << integrator << to_target.err;
    EXPECT_LT(nlohmann::json::parse(to_target.out).at("samples"), 16000) << integrator;
  }
}

TEST(Interrupted, time_that_is_over_is_a_stop) {
  const TemporaryFolder folder;
  const Outcome trace = interflect({"trace", shipped_scene("cornell_box"), "--spp", "1000000", "--threads", "2",
                                    "--max-time", "3s", "-o", folder / "c.exr", "--json"});
  EXPECT_EQ(trace.status, 1) << trace.err;
  EXPECT_TRUE(contains(trace.err, "--max-time is over")) << trace.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "c.exr"));
  EXPECT_EQ(nlohmann::json::parse(trace.out).at("stopped"), true);
  const Outcome in_time = interflect({"info", shipped_scene("cornell_box"), "--max-time", "5min"});
  EXPECT_EQ(in_time.status, 0) << in_time.err;
  const Outcome what = interflect({"info", shipped_scene("cornell_box"), "--max-time", "soon"});
  EXPECT_EQ(what.status, 2);
  EXPECT_TRUE(contains(what.err, "90s, 15min or 2h")) << what.err;
}

TEST(Interrupted, estimates_are_written_with_the_samples_so_far) {
  const TemporaryFolder folder;
  const Outcome trace = interflect({"trace", shipped_scene("holodeck"), "--spp", "1", "--threads", "2", "-o",
                                    folder / "c.exr", "--estimates", folder / "tables", "--accuracy", "0.001%"},
                                   {.interrupt_when = part_of("path tracing")});
  EXPECT_EQ(trace.status, 1) << trace.err;
  EXPECT_TRUE(contains(trace.err, "fewer samples")) << trace.err;
  EXPECT_TRUE(contains(trace.out, "stopped")) << trace.out;
  EXPECT_TRUE(std::filesystem::exists(folder / "tables/surfaces.csv") &&
              std::filesystem::exists(folder / "tables/sensors.csv"));
}

TEST(Interrupted, a_stop_before_there_are_estimates_is_said_and_leaves_no_folder) {
  const TemporaryFolder folder;
  const Outcome trace = interflect({"trace", shipped_scene("cornell_box"), "--spp", "2000", "--threads", "2", "-o",
                                    folder / "c.exr", "--estimates", folder / "tables"},
                                   {.interrupt_when = part_of("rendering front")});
  EXPECT_EQ(trace.status, 1) << trace.err;
  EXPECT_TRUE(contains(trace.err, "no estimates were written")) << trace.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "tables"));
}

TEST(Interrupted, a_solution_is_kept_without_its_bounds) {
  const TemporaryFolder folder;
  const Outcome solve = interflect({"solve", shipped_scene("two_rooms"), "--bounds", "--element-size", "0.7",
                                    "--threads", "2", "--no-pictures", "-o", folder / "out"},
                                   {.interrupt_when = part_of("bounds")});
  EXPECT_EQ(solve.status, 1) << solve.err;
  EXPECT_TRUE(contains(solve.err, "stopped before its bounds were found")) << solve.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "out/solution.vtu"));
  EXPECT_EQ(json_of(folder / "out/summary.json").at("stopped"), true);
}

TEST(Interrupted, elements_made_so_far_are_solved_and_kept) {
  const TemporaryFolder folder;
  const Outcome solve = interflect({"solve", shipped_scene("two_rooms"), "--target-error", "0.001%", "--goal",
                                    "dark_plane", "--threads", "2", "--no-pictures", "-o", folder / "out"},
                                   {.interrupt_when = [](const std::string& err) {  // in a later pass
                                     const auto first = err.find("100 %");
                                     return first != std::string::npos && contains(err.substr(first), "form factors");
                                   }});
  EXPECT_EQ(solve.status, 1) << solve.err;
  EXPECT_TRUE(contains(solve.err, "asked to stop")) << solve.err;
  const nlohmann::json summary = json_of(folder / "out/summary.json");
  EXPECT_EQ(summary.at("adaptation").at("stopped"), "asked to stop");
  EXPECT_GE(summary.at("adaptation").at("passes").size(), 1u);
  EXPECT_EQ(summary.at("stopped"), true);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/sensors.csv"));
}

TEST(Interrupted, a_solve_without_form_factors_leaves_nothing) {
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  const Outcome solve =
      interflect({"solve", shipped_scene("office"), "--element-size", "0.2", "--threads", "2", "--quiet", "-o", out},
                 {.interrupt_when = [&](const std::string&) { return std::filesystem::exists(out); }});
  EXPECT_EQ(solve.status, 1) << solve.err;
  EXPECT_EQ(std::count(solve.err.begin(), solve.err.end(), '\n'), 1) << solve.err;
  EXPECT_TRUE(contains(solve.err, "before there is a solution: nothing is written")) << solve.err;
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Interrupted, a_validation_gives_its_verdict_on_what_it_has_and_says_so_everywhere) {
  const TemporaryFolder folder;
  const Outcome validate = interflect({"validate", shipped_scene("cube"), "--element-size", "0.25", "--all",
                                       "--accuracy", "0.05%", "--threads", "2", "-o", folder / "out"},
                                      {.interrupt_when = part_of("path tracing")});
  EXPECT_EQ(validate.status, 1) << validate.err;
  EXPECT_TRUE(contains(validate.out, "not validated: stopped")) << validate.out;
  EXPECT_TRUE(contains(validate.out, "Not validated: ")) << validate.out;
  EXPECT_TRUE(contains(validate.out, "of the path-traced reference")) << validate.out;
  EXPECT_FALSE(contains(validate.out, "Validated:")) << validate.out;
  EXPECT_FALSE(std::filesystem::exists(folder / "out/validation.png"));
  const auto certificate = json_of(folder / "out/validation.json");
  EXPECT_EQ(certificate.at("stopped"), true);
  EXPECT_EQ(certificate.at("run").at("stopped"), true);
  EXPECT_EQ(certificate.at("passed"), false);
  EXPECT_EQ(json_of(folder / "out/summary.json").at("stopped"), true);
}

TEST(Interrupted, a_validation_stopped_at_its_pictures_keeps_its_verdict) {
  const TemporaryFolder folder;
  const Outcome validate = interflect({"validate", shipped_scene("cube"), "--element-size", "0.25", "--accuracy", "5%",
                                       "--picture-spp", "5000", "--threads", "2", "-o", folder / "out"},
                                      {.interrupt_when = part_of("rendering inside")});
  EXPECT_EQ(validate.status, 1) << validate.err;
  EXPECT_TRUE(contains(validate.out, "\nValidated: FEM within")) << validate.out;
  const auto certificate = json_of(folder / "out/validation.json");
  EXPECT_EQ(certificate.at("stopped"), true);
  EXPECT_EQ(certificate.at("passed"), true);
}

TEST(Interrupted, a_validation_stopped_before_anything_is_traced_keeps_the_solution) {
  const TemporaryFolder folder;
  const std::string summary = folder / "out/summary.json";
  const Outcome validate =
      interflect({"validate", shipped_scene("office"), "--element-size", "1", "--all", "--accuracy", "0.01%",
                  "--no-pictures", "--threads", "2", "-o", folder / "out"},
                 {.interrupt_when = [&](const std::string&) { return std::filesystem::exists(summary); }});
  EXPECT_EQ(validate.status, 1) << validate.err;
  EXPECT_TRUE(contains(validate.err, "interrupted during")) << validate.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out/validation.json"));
  EXPECT_EQ(json_of(summary).at("stopped"), true);
}

/// What `shoot` left: the fields, bit by bit.
std::string field_of(const std::filesystem::path& folder) { return read_file(folder / "solution.vtu"); }

// What was shot is kept, and the rest can be shot later: the solution is that of one run, to the last bit.
TEST(Interrupted, shooting_goes_on_where_it_was_stopped) {
  const TemporaryFolder folder;
  const auto shoot = [&](const std::string& out, std::vector<std::string> more, const Circumstances& how = {}) {
    std::vector<std::string> all{
        "shoot", shipped_scene("cornell_box"), "-o", folder / out, "--no-pictures", "--element-size", "0.05", "--seed",
        "3"};
    all.insert(all.end(), more.begin(), more.end());
    return interflect(all, how);
  };
  ASSERT_EQ(shoot("whole", {"--unshot", "4%"}).status, 0);
  const Outcome stopped = shoot("parts", {"--unshot", "4%", "--max-time", "1s", "--threads", "1"});
  EXPECT_EQ(stopped.status, 1) << stopped.err;
  EXPECT_TRUE(contains(stopped.err, "--resume goes on")) << stopped.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "parts/surfaces.csv"));
  const auto first = json_of(folder / "parts/summary.json"), whole = json_of(folder / "whole/summary.json");
  EXPECT_LT(first.at("shots"), whole.at("shots"));
  // The record says the step: so many shots at once are what was kept, and so are some and then the rest of them.
  const std::string shots = std::to_string(first.at("shots").get<int>());
  EXPECT_EQ(shoot("again", {"--unshot", "4%", "--shots", shots}).status, 1);
  EXPECT_EQ(field_of(folder / "again"), field_of(folder / "parts"));
  EXPECT_EQ(shoot("in_two", {"--unshot", "4%", "--shots", "1"}).status, 1);
  EXPECT_EQ(shoot("in_two", {"--unshot", "4%", "--shots", shots, "--resume"}).status, 1);
  EXPECT_EQ(field_of(folder / "in_two"), field_of(folder / "parts"));
  const Outcome gone_on = shoot("parts", {"--unshot", "4%", "--resume", "--threads", "8"});
  EXPECT_EQ(gone_on.status, 0) << gone_on.err;
  EXPECT_EQ(json_of(folder / "parts/summary.json").at("shots"), whole.at("shots"));
  EXPECT_EQ(field_of(folder / "parts"), field_of(folder / "whole"));

  // Of another scene, of other settings, of nothing: a line each, and what was there stays.
  const std::string kept = read_file(folder / "parts/shots.h5");
  const Outcome other = interflect({"shoot", shipped_scene("cube"), "-o", folder / "parts", "--resume"});
  EXPECT_EQ(other.status, 2);
  EXPECT_TRUE(contains(other.err, "shots.h5: this checkpoint is of another scene")) << other.err;
  const Outcome settings = shoot("parts", {"--resume", "--overshoot", "0.5"});
  EXPECT_EQ(settings.status, 2);
  EXPECT_TRUE(contains(settings.err, "of other settings")) << settings.err;
  EXPECT_EQ(read_file(folder / "parts/shots.h5"), kept);
  const Outcome nothing = shoot("nowhere", {"--resume"});
  EXPECT_EQ(nothing.status, 2);
  EXPECT_TRUE(contains(nothing.err, "there is no such checkpoint")) << nothing.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "nowhere"));
  std::filesystem::resize_file(folder / "parts/shots.h5", kept.size() / 2);
  const Outcome cut = shoot("parts", {"--resume"});
  EXPECT_EQ(cut.status, 2) << cut.err;
  EXPECT_EQ(std::count(cut.err.begin(), cut.err.end(), '\n'), 1) << cut.err;
}

// Pictures on the way.
TEST(Interrupted, shooting_can_be_looked_at) {
  const TemporaryFolder folder;
  const Outcome shoot = interflect({"shoot", shipped_scene("cornell_box"), "-o", folder / "out", "--element-size",
                                    "0.2", "--every", "10", "--unshot", "30%", "--json"});
  ASSERT_EQ(shoot.status, 0) << shoot.err;
  const auto said = nlohmann::json::parse(shoot.out);
  EXPECT_LE(said.at("unshot"), .3);
  const int looks = said.at("shots").get<int>() / 10;
  ASSERT_GT(looks, 0);
  for (int k = 1; k <= looks; ++k) {
    char name[32];
    std::snprintf(name, sizeof name, "out/after_%06d", 10 * k);
    EXPECT_TRUE(std::filesystem::exists(folder / name / "solution.vtu")) << name;
  }
  const std::string history = read_file(folder / "out/shots.csv");
  EXPECT_GE(std::count(history.begin(), history.end(), '\n'), 1 + looks);
}

}  // namespace
}  // namespace interflect::test
