#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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
  const std::string table = compared.out.substr(compared.out.find("sweeps to"));
  EXPECT_TRUE(contains(table, "  refused\nrefused: solver 'control-variate-stochastic-jacobi': a closed room expected"))
      << compared.out;
  EXPECT_LT(table.find('\n'), 120u) << table;
}

}  // namespace
}  // namespace interflect::test
