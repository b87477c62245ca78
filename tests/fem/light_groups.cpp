#include "measure/light_groups.h"

#include <gtest/gtest.h>

#include "fem/radiosity.h"
#include "scene/builder.h"

namespace interflect::fem {
namespace {

/// A room with two lamps, one of which is two surfaces, and a body between; only some of them lit.
scene::Scene room(bool first = true, bool second = true) {
  scene::SceneBuilder builder({"a", "b"}, scene::Quantity::radiometric);
  const auto material = [&](const std::string& name, double a, double b, double exitance) {
    scene::Material out{.name = name, .reflectance = Spectrum(), .exitance = Spectrum()};
    out.reflectance[0] = a, out.reflectance[1] = b;
    out.exitance[0] = exitance, out.exitance[1] = 2 * exitance;
    return builder.add_material(out);
  };
  const auto walls = material("walls", .6, .4, 0), thing = material("thing", .2, .7, 0),
             left = material("left", 0, 0, first ? 3 : 0), right = material("right", .1, .1, second ? 5 : 0);
  builder.add_box("room", {Vec3(0, 0, 0), Vec3(3, 2, 2)}, walls, scene::SceneBuilder::Facing::inward);
  builder.add_box("thing", {Vec3(1.2, .5, .2), Vec3(1.8, 1.4, .9)}, thing);
  const auto lamp = [&](const std::string& name, double x, double y, scene::MaterialId of) {
    builder.add_polygon(name, {{{x, y, 1.9}, {x, y + .4, 1.9}, {x + .4, y + .4, 1.9}, {x + .4, y, 1.9}}, {}}, of);
  };
  lamp("l", .3, .8, left);
  lamp("r1", 2.1, .3, right);
  lamp("r2", 2.1, 1.2, right);
  return builder.finish();
}

RadiositySolution solved(const scene::Scene& scene, RadiositySettings settings, bool groups) {
  settings.light_groups = groups;
  core::LocalRun run(4, 2);
  return solve_radiosity(scene, settings, run.get());
}

/// The largest difference, over the largest value.
double distance(std::span<const Spectrum> a, std::span<const Spectrum> b) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference = std::max(difference, abs(a[i] - b[i]).max());
    size = std::max(size, b[i].max());
  }
  return difference / size;
}

// Of constants with sampled visibility, polynomials, and values at nodes.
TEST(LightGroups, add_up_and_are_what_they_are_alone) {
  struct Way {
    const char* form_factors;
    int order;
    Projection projection;
  };
  for (const Way& way : {Way{"gauss-lambert", 0, Projection::galerkin}, Way{"analytic", 1, Projection::galerkin},
                         Way{"analytic", 0, Projection::centroids}}) {
    RadiositySettings settings;
    settings.element_size = 1.2;
    settings.form_factors = way.form_factors;
    settings.order = way.order;
    settings.projection = way.projection;
    const scene::Scene both = room();
    const RadiositySolution all = solved(both, settings, true);
    ASSERT_EQ(measure::light_groups(both), (std::vector<std::string>{"left", "right"}));
    ASSERT_EQ(all.of_groups.size(), 2u);
    std::vector<Spectrum> B, H;
    for (std::size_t i = 0; i < all.radiosity.size(); ++i) {
      B.push_back(all.of_groups[0].radiosity[i] + all.of_groups[1].radiosity[i]);
      H.push_back(all.of_groups[0].irradiance[i] + all.of_groups[1].irradiance[i]);
    }
    EXPECT_LT(distance(B, all.radiosity), 1e-8);
    EXPECT_LT(distance(H, all.irradiance), 1e-8);
    for (std::size_t g = 0; g < 2; ++g) {
      const RadiositySolution alone = solved(room(g == 0, g == 1), settings, false);
      const RadiositySolution& group = all.of_groups[g];
      EXPECT_LT(distance(group.radiosity, alone.radiosity), 1e-12);
      EXPECT_LT(distance(group.irradiance_error, alone.irradiance_error), 1e-9);
      if (way.order == 0 && way.projection == Projection::galerkin) {
        EXPECT_LT(distance(group.irradiance_noise, alone.irradiance_noise), 1e-9);
      }
      EXPECT_EQ(group.exitance, alone.exitance);
    }
  }
}

}  // namespace
}  // namespace interflect::fem
