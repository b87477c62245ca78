#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/apps/csv_rows.h"
#include "tests/apps/program.h"

namespace interflect::test {
namespace {

using nlohmann::json;

// By rays it is known what an open scene loses: their noise is in what is left for form factors.  A closed one loses
// none, and without a matrix there are no form factors.
TEST(Solve, the_energy_balance_says_what_is_noise) {
  const TemporaryFolder folder;
  const auto energy_of = [&](const char* scene, const std::vector<std::string>& more) {
    std::vector<std::string> command{"solve", shipped_scene(scene), "--element-size", "0.5", "--no-pictures",
                                     "-o",    folder / "out"};
    command.insert(command.end(), more.begin(), more.end());
    const std::string text = interflect(command).out;
    const std::size_t at = text.find("energy  ");
    return at == std::string::npos ? text : text.substr(at, text.find('\n', at) - at);
  };
  const char* noise = "% (noise of the rays that escape), left over";
  const std::string open = energy_of("cornell_box", {}), closed = energy_of("cube", {}),
                    sampled = energy_of("cornell_box", {"--solver", "stochastic-jacobi"});
  EXPECT_TRUE(contains(open, "form-factor error ") && contains(open, " % +- ") && contains(open, noise)) << open;
  EXPECT_TRUE(contains(closed, "form-factor error ") && !contains(closed, "noise")) << closed;
  EXPECT_TRUE(!contains(sampled, "form-factor error") && contains(sampled, " (noise)")) << sampled;
}

// By rays alone: no matrix, and every file that there is with one.
TEST(Solve, is_done_by_rays_alone) {
  const TemporaryFolder folder;
  const Outcome solved = interflect({"solve", shipped_scene("cornell_box"), "--element-size", "0.2", "--solver",
                                     "regular-stochastic-jacobi", "--noise", "3%", "-o", folder / "out"});
  ASSERT_EQ(solved.status, 0) << solved.err;
  EXPECT_TRUE(contains(solved.out, "standard error")) << solved.out;
  EXPECT_FALSE(contains(solved.out, "sum_j F_ij")) << solved.out;
  EXPECT_TRUE(contains(solved.out, "which more rays do not lower")) << solved.out;
  EXPECT_TRUE(std::filesystem::exists(folder / "out/solution.vtu"));
  const json summary = json::parse(read_file(folder / "out/summary.json"));
  EXPECT_EQ(summary.at("settings").at("solver"), "regular-stochastic-jacobi");
  const Outcome again =
      interflect({"solve", shipped_scene("cornell_box"), "--element-size", "0.2", "--solver",
                  "regular-stochastic-jacobi", "--noise", "3%", "--threads", "3", "-o", folder / "again"});
  EXPECT_EQ(read_file(folder / "out/surfaces.csv"), read_file(folder / "again/surfaces.csv"));
  const Outcome refused = interflect(
      {"solve", shipped_scene("cornell_box"), "--solver", "shooting-collision", "--order", "1", "-o", folder / "no"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(contains(refused.err, "polynomials of order 1: 'stochastic-jacobi' would do")) << refused.err;
  const Outcome stopped =
      interflect({"solve", shipped_scene("cornell_box"), "--element-size", "0.2", "--solver", "shooting-collision",
                  "--noise", "0.001%", "--max-time", "3s", "--no-pictures", "-o", folder / "stopped"});
  EXPECT_TRUE(contains(stopped.out, "out of time")) << stopped.out;
  EXPECT_TRUE(std::filesystem::exists(folder / "stopped/solution.vtu"));
}

// Polynomials of order 1 and 2 by rays: the goal within what both state of it, and a picture of the field.
TEST(Solve, has_polynomials_by_rays) {
  const TemporaryFolder folder;
  const auto plane_of = [&](const std::vector<std::string>& how) {
    std::vector<std::string> command{"solve",       shipped_scene("cornell_box"), "--element-size", "0.3", "-o",
                                     folder / "out"};
    command.insert(command.end(), how.begin(), how.end());
    const Outcome solved = interflect(command);
    EXPECT_EQ(solved.status, 0) << solved.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "out/irradiance.png"));
    const json summary = json::parse(read_file(folder / "out/summary.json"));
    for (const json& sensor : summary.at("sensors"))
      if (sensor.at("name") == "plane_400") return std::pair<double, double>(sensor.at("mean"), sensor.at("error"));
    return std::pair<double, double>();
  };
  for (const char* order : {"1", "2"}) {
    const auto [exact, exact_error] = plane_of({"--order", order});
    const auto [found, error] = plane_of({"--order", order, "--solver", "regular-stochastic-jacobi", "--noise", "2%"});
    EXPECT_GT(exact, 0);
    EXPECT_NEAR(found, exact, error + exact_error) << order;
    EXPECT_LT(error, .1 * exact) << order;
  }
}

// What time cut off is had again by the steps that its record says: of iterations, and of rounds of samples.
TEST(Solve, of_a_run_that_was_stopped_can_be_had_again) {
  const TemporaryFolder folder;
  const std::string white = folder.write("white.json", R"({ "format": "interflect/scene/1", "units": "m",
  "materials": { "white": { "type": "diffuse", "reflectance": 0.9999, "exitance": 0.0001 } },
  "geometry": [ { "box": { "min": [0,0,0], "max": [1,1,1] }, "facing": "inward", "material": "white" } ] })");
  const auto solve = [&](const std::string& scene, const std::string& solver, const std::string& out,
                         const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"solve",         scene, "--element-size", "0.1", "--solver", solver,
                                       "--no-pictures", "-o",  folder / out};
    const std::vector<std::string> accuracy =
        solver == "jacobi" ? std::vector<std::string>{"--form-factors", "analytic", "--solver-tolerance", "1e-15"}
                           : std::vector<std::string>{"--noise", "0.001%"};
    for (const auto& also : {accuracy, more}) arguments.insert(arguments.end(), also.begin(), also.end());
    return interflect(arguments);
  };
  for (const auto& [solver, scene] :
       {std::pair<std::string, std::string>{"jacobi", white}, {"shooting-collision", shipped_scene("cornell_box")}}) {
    const Outcome stopped = solve(scene, solver, "stopped", {"--steps", "100000000", "--max-time", "3s"});
    ASSERT_TRUE(contains(stopped.out, "out of time")) << stopped.out << stopped.err;
    const json first = json::parse(read_file(folder / "stopped/summary.json")).at("solver");
    ASSERT_GT(first.at("iterations"), 0);
    solve(scene, solver, "again", {"--steps", std::to_string(first.at("iterations").get<int>())});
    const json again = json::parse(read_file(folder / "again/summary.json")).at("solver");
    EXPECT_EQ(again.at("residual_history"), first.at("residual_history")) << solver;
    EXPECT_GT(first.at("rows_or_rays"), 0) << solver;
    EXPECT_EQ(again.at("rows_or_rays"), first.at("rows_or_rays")) << solver;
    const auto before = read_csv(folder / "stopped/surfaces.csv"), after = read_csv(folder / "again/surfaces.csv");
    ASSERT_EQ(before.size(), after.size());
    const auto radiosity = 2u, irradiance = before[0].size() > 10 ? 5u : 3u;
    for (std::size_t k = 0; k < before.size(); ++k)
      for (const std::size_t column : {radiosity, irradiance}) EXPECT_EQ(after[k][column], before[k][column]) << solver;
  }
}

}  // namespace
}  // namespace interflect::test
