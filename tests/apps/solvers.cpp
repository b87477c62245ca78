#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/format.h"
#include "tests/apps/program.h"

namespace interflect::test {
namespace {

using nlohmann::json;

TEST(Solvers, are_listed_and_compared) {
  const Outcome list = interflect({"solvers"});
  EXPECT_EQ(list.status, 0);
  for (const char* name : {"conjugate-gradients", "southwell", "progressive"})
    EXPECT_TRUE(contains(list.out, name)) << list.out;
  EXPECT_EQ(json::parse(interflect({"solvers", "--json"}).out).at("solvers").at(0).at("name"), "automatic");

  const TemporaryFolder folder;
  const Outcome compared = interflect({"compare-solvers", shipped_scene("cube"), "--element-size", "0.3", "--solvers",
                                       "conjugate-gradients", "southwell", "shooting-collision", "-o", folder / "out"});
  EXPECT_EQ(compared.status, 0) << compared.err;
  EXPECT_TRUE(contains(compared.out, "southwell: converged")) << compared.out;
  const std::string csv = read_file(folder / "out/solvers.csv");
  EXPECT_TRUE(contains(csv, "solver,iteration,rows_or_rays,seconds,error,residual_or_noise")) << csv;
  EXPECT_TRUE(contains(csv, "conjugate-gradients,1,")) << csv;
  EXPECT_EQ(interflect({"compare-solvers", shipped_scene("cube"), "--solvers", "gauss", "-o", folder / "x"}).status, 2);
}

// Why one does not take an open scene is a sentence below the table, not in a column of it.
TEST(Solvers, that_refuse_say_why_below_the_table) {
  const TemporaryFolder folder;
  const Outcome compared =
      interflect({"compare-solvers", shipped_scene("cornell_box"), "--element-size", "0.3", "--solvers", "jacobi",
                  "control-variate-stochastic-jacobi", "-o", folder / "out"});
  EXPECT_EQ(compared.status, 0) << compared.err;
  EXPECT_TRUE(contains(compared.out, "control-variate-stochastic-jacobi: refused\n")) << compared.out;
  const std::string table = compared.out.substr(compared.out.find("work to 10 %"));
  EXPECT_TRUE(contains(table, "  refused\nrefused: solver 'control-variate-stochastic-jacobi': a closed room expected"))
      << compared.out;
  EXPECT_LT(table.find('\n'), 120u) << table;
}

// What `solvers` says that `solve` does not take, or takes only in part, is what it refuses.
TEST(Solvers, are_listed_with_what_solve_makes_of_them) {
  const TemporaryFolder folder;
  const auto solve = [&](const std::string& solver, const char* scene, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{
        "solve", shipped_scene(scene), "--element-size", "0.5", "--solver", solver, "--no-pictures",
        "-o",    folder / "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return interflect(arguments).status;
  };
  std::size_t refused = 0;
  const json list = json::parse(interflect({"solvers", "--json"}).out);
  for (const json& each : list.at("solvers")) {
    const std::string name = each.at("name"), in_solve = each.at("in_solve");
    const bool samples = each.at("samples");
    EXPECT_EQ(each.at("solve_takes_it"), in_solve != "no") << name;
    if (in_solve == "no") {
      EXPECT_EQ(solve(name, "cube"), 2) << name;
    } else if (in_solve == "not at nodes") {
      EXPECT_EQ(solve(name, "cube"), 0) << name;
      EXPECT_EQ(solve(name, "cube", {"--projection", "vertices"}), 2) << name;
    } else if (in_solve == "no mirrors") {
      EXPECT_EQ(solve(name, "mirror_room"), 2) << name;
    } else if (in_solve == "closed rooms") {
      EXPECT_EQ(solve(name, "cornell_box"), 2) << name;
      EXPECT_EQ(solve(name, "mirror_room"), 2) << name;
    } else if (!samples) {
      EXPECT_EQ(solve(name, "cube", {"--projection", "vertices"}), 0) << name;
      continue;
    } else {
      continue;
    }
    ++refused;
  }
  EXPECT_GE(refused, 9u);
}

// Which one number it is has to be said, before the work.
TEST(Solvers, of_one_number_want_to_be_told_which) {
  const Outcome compared = interflect({"compare-solvers", shipped_scene("cube"), "--solvers", "adjoint", "-o", "x"});
  EXPECT_EQ(compared.status, 2);
  EXPECT_TRUE(contains(compared.err, "solver 'adjoint': it finds one number, and --goal says which")) << compared.err;
}

// What the numbers are of is said where they are.
TEST(Solvers, are_compared_by_numbers_that_are_explained) {
  const TemporaryFolder folder;
  const auto compare = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"compare-solvers", shipped_scene("cornell_box"), "--element-size", "0.5", "-o",
                                       folder / "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return interflect(arguments).out;
  };
  const std::string all = compare({"--solvers", "jacobi"}),
                    one = compare({"--noise", "10%", "--goal", "floor", "--solvers", "jacobi", "adjoint"});
  EXPECT_TRUE(contains(all, "error: relative, L2 over the surfaces") && !contains(all, "rays")) << all;
  EXPECT_TRUE(contains(one, "error: relative, of 'floor'") && contains(one, "rays of those that sample")) << one;
}

// By iterations and by all who find it: in the table, in the JSON and in the CSV, beside what it is.
TEST(Solvers, of_one_number_tell_it) {
  const TemporaryFolder folder;
  const auto compare = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "compare-solvers", shipped_scene("cube"), "--element-size", "0.3",     "--noise", "2%",          "--goal",
        "ceiling",         "--solvers",           "jacobi",         "adjoint", "-o",      folder / "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return interflect(arguments).out;
  };
  const std::string text = compare({});
  const json said = json::parse(compare({"--json"}));
  EXPECT_EQ(said.at("goal"), "ceiling");
  EXPECT_EQ(said.at("stopped"), false);
  const double exact = said.at("value_of_solution");
  EXPECT_GT(exact, 0);
  for (const json& each : said.at("solvers")) {
    const double value = each.at("value"), error = each.at("error");
    EXPECT_NEAR(std::abs(value - exact), error * exact, 1e-9 * exact) << each;
    EXPECT_EQ(each.at("standard_error") > 0, each.at("solver") == "adjoint") << each;
  }
  EXPECT_TRUE(contains(text, "value: E_avg(ceiling) [W/m2] as the solver has it in the end")) << text;
  EXPECT_TRUE(contains(text, "by the solution " + core::format("%.6g", exact))) << text;
  EXPECT_TRUE(contains(text, " +- ")) << text;
  EXPECT_TRUE(contains(read_file(folder / "out/solvers.csv"),
                       ",residual_or_noise,value,standard_error,value_of_solution\njacobi,1,"));
}

// What there is of a comparison that was stopped is written; what is missing is said in one line, even to those that
// want no others.
TEST(Solvers, that_were_compared_are_kept_when_time_is_over) {
  const TemporaryFolder folder;
  const Outcome stopped = interflect({"compare-solvers", shipped_scene("cube"), "--element-size", "0.3", "--noise",
                                      "0.0001%", "--max-time", "3s", "--quiet", "--json", "-o", folder / "out",
                                      "--solvers", "jacobi", "shooting-collision", "stochastic-jacobi", "southwell"});
  EXPECT_EQ(stopped.status, 1) << stopped.err;
  EXPECT_TRUE(contains(stopped.err,
                       "stopped: shooting-collision is kept as far as it came; left out: "
                       "stochastic-jacobi, southwell\n"))
      << stopped.err;
  EXPECT_EQ(std::count(stopped.err.begin(), stopped.err.end(), '\n'), 1) << stopped.err;
  const json said = json::parse(stopped.out);
  EXPECT_EQ(said.at("stopped"), true);
  EXPECT_EQ(said.at("left_out"), (json{"stochastic-jacobi", "southwell"}));
  ASSERT_EQ(said.at("solvers").size(), 2u);
  EXPECT_EQ(said.at("solvers").at(0).at("stopped"), "converged");
  EXPECT_EQ(said.at("solvers").at(1).at("stopped"), "out of time");
  EXPECT_TRUE(contains(read_file(folder / "out/solvers.csv"), "\nshooting-collision,2,"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out/solvers_rays.png"));
}

// Rays have a picture where there are any, and an earlier one does not stay where there are none.
TEST(Solvers, that_sample_have_a_picture_of_rays) {
  const TemporaryFolder folder;
  const auto pictures = [&](const std::vector<std::string>& solvers) {
    std::vector<std::string> arguments{
        "compare-solvers", shipped_scene("cube"), "--element-size", "0.5", "-o", folder / "out", "--solvers"};
    arguments.insert(arguments.end(), solvers.begin(), solvers.end());
    EXPECT_EQ(interflect(arguments).status, 0);
    std::string found;
    for (const char* name : {"work", "rays", "time"})
      if (std::filesystem::exists(folder / (std::string("out/solvers_") + name + ".png"))) found += name;
    return found;
  };
  EXPECT_EQ(pictures({"jacobi", "shooting-collision"}), "workraystime");
  EXPECT_EQ(pictures({"jacobi"}), "worktime");
  EXPECT_EQ(pictures({"shooting-collision"}), "raystime");
}

}  // namespace
}  // namespace interflect::test
