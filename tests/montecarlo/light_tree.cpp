#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "core/moments.h"
#include "montecarlo/light/light_tree.h"
#include "montecarlo/light/point.h"
#include "montecarlo/light/rectangle.h"
#include "montecarlo/light/sphere.h"
#include "montecarlo/light/spot.h"
#include "tests/montecarlo/light_numbers.h"
#include "tests/montecarlo/statistics.h"
#include "tests/support/shapes.h"

// Picks among many lights.
namespace interflect::montecarlo {
namespace {

using test::grey;
using test::numbers_of;

/// Lights of all kinds with powers 1 to 1e6 in a cube, and some beyond.
std::vector<std::unique_ptr<Light>> many_lights(int n, double scale) {
  std::vector<std::unique_ptr<Light>> lights;
  core::RandomNumbers numbers(3, 0, 0);
  for (int k = 0; k < n; ++k) {
    const Vec3 x = scale * Vec3(10 * test::random_point(numbers));
    const Vec3 way = test::cosine_about(-Vec3::UnitZ(), numbers);
    const Spectrum power = grey(std::pow(10, 6 * numbers.next()));
    switch (k % 4) {
      case 0:
        lights.push_back(std::make_unique<PointSource>(scene::PointLight{"p", x, power}));
        break;
      case 1:
        lights.push_back(std::make_unique<Spot>(scene::SpotLight{"s", x, way, power, .95, .8}));
        break;
      case 2: {
        const Vec3 u = scale * .2 * way.cross(Vec3::UnitX()).normalized(), v = way.cross(u);
        lights.push_back(std::make_unique<RectangleLight>(x, u, v, way, power));
        break;
      }
      default:
        lights.push_back(std::make_unique<BallLight>(scene::SphereLight{"b", x, .05 * scale, power}));
    }
  }
  return lights;
}

// At a hundred places: probabilities add up to 1, are those that picks tell, bit by bit, and with which picks come; and
// no light that gives anything there is never picked.
TEST(LightTree, picks_as_it_says_and_forgets_no_light) {
  const std::array<std::pair<double, std::size_t>, 3> places_at{{{1., 100}, {1e-6, 5}, {1e6, 5}}};
  std::size_t places_in_all = 0;
  for (const auto& [scale, places] : places_at) places_in_all += places;
  test::Family family(test::tails_of_counts * places_in_all);
  for (const auto& [scale, places] : places_at) {
    const auto lights = many_lights(10'000, scale);
    std::vector<LightExtent> extents;
    for (const auto& light : lights) extents.push_back(light->extent());
    const LightTree tree(extents);
    EXPECT_LE(tree.depth(), 60);
    core::RandomNumbers numbers(4, 0, 0);
    for (std::size_t p = 0; p < places; ++p) {
      const Vec3 x = scale * Vec3(12 * test::random_point(numbers) - Vec3(1, 1, 1));
      const Place at{x, p % 5 == 0 ? Vec3(Vec3::Zero()) : test::cosine_about(Vec3::UnitZ(), numbers)};
      std::vector<double> expected(lights.size()), counts(lights.size());
      double sum = 0;
      constexpr int n = 20'000;
      for (std::uint32_t l = 0; l < lights.size(); ++l) {
        const double probability = tree.probability(l, at);
        sum += probability;
        expected[l] = n * probability;
        if (probability > 0) continue;
        for (std::uint64_t k = 0; k < 8; ++k) {
          const auto u = numbers_of(200, k);
          const auto s = lights[l]->sample_arriving(at, u[0], u[1]);
          EXPECT_TRUE(!s || s->light.is_zero() || (!at.normal.isZero() && s->way.dot(at.normal) <= 0));
        }
      }
      EXPECT_NEAR(sum, 1, 1e-12);
      for (std::uint64_t k = 0; k < n; ++k) {
        const auto picked = tree.pick(at, numbers_of(static_cast<std::uint32_t>(300 + p), k)[0]);
        ++counts[picked.light];
        ASSERT_EQ(picked.probability, tree.probability(picked.light, at));
      }
      test::expect_as_expected(counts, expected, family, "place " + std::to_string(p));
    }
  }
}

// With one light on at a time, what picks find over their probability is on average what the light gives directly.
TEST(LightTree, finds_each_light_as_bright_as_it_is) {
  const auto lights = many_lights(400, 1);
  std::vector<LightExtent> extents;
  for (const auto& light : lights) extents.push_back(light->extent());
  const LightTree tree(extents);
  const Place at{Vec3(5, 4, -.5), Vec3::UnitZ()};
  const auto score = [&](std::uint32_t l, double u, double v) {  // of one draw, over the chance of the pick
    const auto arriving = lights[l]->sample_arriving(at, u, v);
    if (!arriving) return 0.0;
    const double cosine = std::max(0.0, at.normal.dot(arriving->way));
    return arriving->light[0] * cosine / (arriving->pdf_solid_angle > 0 ? arriving->pdf_solid_angle : 1);
  };
  constexpr int n = 400'000, fine = 64;
  std::vector<core::ScalarMoments> found(lights.size());
  std::vector<int> picks(lights.size());
  for (std::uint64_t k = 0; k < n; ++k) {
    const auto u = numbers_of(400, k);
    const auto picked = tree.pick(at, u[0]);
    ++picks[picked.light];
    found[picked.light].add(score(picked.light, u[1], u[2]) / picked.probability);
  }
  const auto seldom = [](int count) { return count < 100; };  // too rare to be normal
  const auto looked_at = picks.size() - static_cast<std::size_t>(std::count_if(picks.begin(), picks.end(), seldom));
  EXPECT_GT(looked_at, 50u);
  test::Family family(2 * looked_at);
  for (std::uint32_t l = 0; l < lights.size(); ++l) {
    if (seldom(picks[l])) continue;
    double truth = 0;
    for (int i = 0; i < fine; ++i)
      for (int j = 0; j < fine; ++j) truth += score(l, (i + .5) / fine, (j + .5) / fine) / (fine * fine);
    found[l].merge(core::ScalarMoments(n - found[l].count(), 0, 0));  // all other picks
    EXPECT_NEAR(found[l].mean(), truth, family.z() * found[l].standard_error() + 2e-3 * truth) << l;
  }
}

}  // namespace
}  // namespace interflect::montecarlo
