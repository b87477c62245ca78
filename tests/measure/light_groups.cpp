#include "measure/light_groups.h"

#include <gtest/gtest.h>

#include "scene/builder.h"

namespace interflect::measure {
namespace {

TEST(LightGroups, are_of_what_shines) {
  scene::SceneBuilder builder({"y"});
  const auto material = [&](const std::string& name, double exitance, const std::string& group) {
    scene::Material out{.name = name, .reflectance = Spectrum(.5), .exitance = Spectrum(exitance)};
    out.group = group;
    return builder.add_material(out);
  };
  const auto dark = material("dark", 0, "ceiling"), lamp = material("lamp", 1, ""),
             north = material("north", 2, "ceiling"), south = material("south", 3, "ceiling");
  int k = 0;
  for (const auto id : {dark, lamp, south, north, lamp}) {
    const double x = 2.0 * k++;
    builder.add_polygon("p", {{{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}}, {}}, id);
  }
  EXPECT_EQ(light_groups(builder.finish()), (std::vector<std::string>{"lamp", "ceiling"}));
}

}  // namespace
}  // namespace interflect::measure
