#include "measure/light_groups.h"

#include <gtest/gtest.h>

#include "core/error.h"
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

// Of surfaces by their groups, of others by their names; balls stand where they stood.
TEST(LightGroups, shine_alone) {
  scene::SceneBuilder builder({"y"});
  scene::Material lamp{.name = "lamp", .reflectance = Spectrum(.5), .exitance = Spectrum(1)};
  lamp.group = "ceiling";
  scene::Material desk{.name = "desk", .reflectance = Spectrum(.5), .exitance = Spectrum(2)};
  for (const auto id : {builder.add_material(lamp), builder.add_material(desk)})
    builder.add_polygon("p", {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}}, id);
  scene::Lights& lights = builder.scene().lights;
  lights.points.push_back({"bulb", Vec3(0, 0, 1), Spectrum(3)});
  lights.spots.push_back({"spot", Vec3(0, 0, 1), -Vec3::UnitZ(), Spectrum(4), .9, .8});
  lights.spheres.push_back({"ball", Vec3(3, 0, 1), .1, Spectrum(5)});
  lights.suns.push_back({"sun", -Vec3::UnitZ(), Spectrum(6)});
  lights.sky = scene::Sky{Vec3::UnitZ(), Spectrum(7), Spectrum(8)};
  const scene::Scene scene = builder.finish();
  const auto shining = [](const scene::Scene& lit) {
    std::string all;
    for (const scene::Material& material : lit.materials)
      if (!material.exitance.is_zero()) all += material.name + ' ';
    for (const auto& light : lit.lights.points) all += light.name + ' ';
    for (const auto& light : lit.lights.spots) all += light.name + ' ';
    for (const auto& light : lit.lights.spheres)
      if (!light.exitance.is_zero()) all += light.name + ' ';
    for (const auto& light : lit.lights.suns) all += light.name + ' ';
    return all + (lit.lights.has_sky() ? "sky " : "");
  };
  EXPECT_EQ(shining(scene), "lamp desk bulb spot ball sun sky ");
  for (const auto& [group, expected] : std::vector<std::pair<std::string, std::string>>{{"ceiling", "lamp "},
                                                                                        {"desk", "desk "},
                                                                                        {"bulb", "bulb "},
                                                                                        {"spot", "spot "},
                                                                                        {"ball", "ball "},
                                                                                        {"sun", "sun "},
                                                                                        {"sky", "sky "}}) {
    const scene::Scene lit = lit_by(scene, group);
    EXPECT_EQ(shining(lit), expected);
    EXPECT_EQ(lit.lights.spheres.size(), 1u);
  }
  try {
    lit_by(scene, "lamp");
    ADD_FAILURE();
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("ceiling, desk, bulb, spot, ball, sun, sky"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace interflect::measure
