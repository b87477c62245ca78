#include "montecarlo/light/light_set.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "tests/support/chi_squared.h"
#include "tests/support/shapes.h"

// All lights of a scene, and which of them is picked.
namespace interflect::montecarlo {
namespace {

Spectrum colour(double a, double b) {
  Spectrum s;
  s[0] = a, s[1] = b;
  return s;
}

// One rectangle is one light, whatever its facets; what is none is a light a facet; and points of each are known again.
TEST(LightSet, picks_by_power_and_knows_its_lights_at_hits) {
  scene::SceneBuilder builder({"a", "b"});
  scene::Material bright, dim;
  bright.exitance = colour(2, 10);
  dim.exitance = colour(1, 0);
  const auto big = builder.add_material(dim), small = builder.add_material(bright), none = builder.add_material({});
  builder.add_box("big", {Vec3(0, 0, 0), Vec3(2, 2, 2)}, big);
  builder.add_box("dark", {Vec3(0, 0, 4), Vec3(2, 2, 5)}, none);
  builder.add_polygon("kite", {{Vec3(5, 0, 0), Vec3(5.1, 0, 0), Vec3(5.2, .3, 0), Vec3(5, .1, 0)}, {}}, small);
  const scene::Scene scene = builder.finish();
  const LightSet lights(scene, LightSet::Picking::by_power);
  ASSERT_EQ(lights.size(), 6u + 2u);
  EXPECT_EQ(lights.of_facet(0), lights.of_facet(1));
  EXPECT_FALSE(lights.of_facet(12));
  double power = 0, sum = 0;
  for (std::uint32_t l = 0; l < lights.size(); ++l) power += lights[l].flux().max();
  EXPECT_NEAR(power, 24 + 10 * scene.area(scene::SurfaceId{12}), 1e-12);
  EXPECT_NEAR(lights.flux()[1], 10 * scene.area(scene::SurfaceId{12}), 1e-12);
  const Place at{Vec3(1, 1, 3), Vec3::Zero()};
  for (std::uint32_t l = 0; l < lights.size(); ++l) {
    EXPECT_NEAR(lights.probability(l, at), lights[l].flux().max() / power, 1e-14);
    sum += lights.probability(l, at);
  }
  EXPECT_NEAR(sum, 1, 1e-14);
  EXPECT_EQ(lights.largest_find(), colour(2, 10));
}

// Lights near and afar: probabilities add up to 1, are those that picks tell, and are those with which picks come.
TEST(LightSet, picks_near_and_far_lights_as_it_says) {
  scene::SceneBuilder builder({"a", "b"});
  builder.add_box("box", {Vec3(0, 0, 0), Vec3(1, 1, 1)}, builder.add_material(test::diffuse("box", .5, .01)));
  scene::Lights& others = builder.scene().lights;
  for (int k = 0; k < 20; ++k)
    others.points.push_back({"p" + std::to_string(k), Vec3(.3 * k - 3, 2 + .1 * k, 2), colour(1. + k % 7, 0)});
  others.suns.push_back({"sun", -Vec3::UnitZ(), colour(1, 1)});
  others.sky = scene::Sky{Vec3::UnitZ(), colour(1, 1), colour(0, 0)};
  const scene::Scene scene = builder.finish();
  const Place at{Vec3(.5, .5, 1), Vec3::UnitZ()};
  constexpr int n = 100'000;
  for (const auto picking : {LightSet::Picking::by_power, LightSet::Picking::by_tree}) {
    const LightSet lights(scene, picking);
    std::vector<double> expected, counts(lights.size());
    double sum = 0;
    for (std::uint32_t l = 0; l < lights.size(); ++l) {
      sum += lights.probability(l, at);
      expected.push_back(n * lights.probability(l, at));
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    core::RandomNumbers numbers(5, 0, 0);
    for (int k = 0; k < n; ++k) {
      const LightSet::Picked picked = lights.pick(at, numbers.next());
      ++counts[picked.light];
      ASSERT_EQ(picked.probability, lights.probability(picked.light, at));
    }
    test::expect_as_expected(counts, expected, 1e-3 / 4, picking == LightSet::Picking::by_tree ? "tree" : "power");
  }
}

}  // namespace
}  // namespace interflect::montecarlo
