#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/apps/program.h"

namespace interflect::test {
namespace {

using nlohmann::json;

const json& integrator(const json& list, const std::string& name) {
  for (const json& each : list)
    if (each.at("name") == name) return each;
  throw std::runtime_error("no integrator " + name);
}

// By what the methods are, not by the list: path tracing cannot meet a point by way of a mirror, light tracing no lamp
// in one, and what is not traced from a solution is in the mean what it is.
TEST(Integrators, are_listed_with_what_they_find) {
  const json list = json::parse(interflect({"integrators", "--json"}).out).at("integrators");
  EXPECT_EQ(list.size(), 8u);
  for (const json& each : list) {
    const std::string name = each.at("name");
    EXPECT_EQ(each.at("needs_solution"), name == "two-pass" || name == "controlled") << name;
    EXPECT_EQ(each.at("unbiased"), name != "two-pass" && name != "whitted") << name;
    EXPECT_EQ(each.at("by_chance"), name == "unidirectional") << name;
    EXPECT_FALSE(each.at("summary").get<std::string>().empty()) << name;
  }
  EXPECT_EQ(integrator(list, "path").at("misses").at("points"), "PSE");
  EXPECT_EQ(integrator(list, "light").at("misses").at("points"), "ASE");
  EXPECT_EQ(integrator(list, "light").at("misses").at("patches"), "");
  EXPECT_EQ(integrator(list, "unidirectional").at("misses").at("patches"), "PE");
}

// What a list says that one misses, it refuses where a scene may have it.
TEST(Integrators, refuse_what_the_list_says_that_they_miss) {
  const TemporaryFolder folder;
  const json list = json::parse(interflect({"integrators", "--json"}).out).at("integrators");
  for (const json& each : list) {  // of the cube's paths, A D* E, whose second shortest is ADE
    const std::string name = each.at("name"), misses = each.at("misses").at("pixels");
    if (each.at("needs_solution")) continue;  // of which each takes a solve
    const bool in_cube = misses.find_first_not_of("ADE") == std::string::npos && !misses.empty();
    const Outcome traced = interflect(
        {"trace", shipped_scene("cube"), "--integrator", name, "--spp", "16", "-o", folder / (name + ".png")});
    EXPECT_EQ(traced.status, in_cube ? 2 : 0) << name << ": " << misses << traced.err;
  }
}

TEST(Integrators, are_told_of_to_people) {
  const Outcome told = interflect({"integrators"});
  EXPECT_EQ(told.status, 0);
  EXPECT_TRUE(contains(told.out, "path\n  paths from what is measured")) << told.out;
  EXPECT_TRUE(contains(told.out, "to patches, points  (A|F).*E|(P|B)((D|G).*)?E, not PSE\n")) << told.out;
  EXPECT_TRUE(contains(told.out, "needs               a radiosity solution, which is found first\n")) << told.out;
}

}  // namespace
}  // namespace interflect::test
