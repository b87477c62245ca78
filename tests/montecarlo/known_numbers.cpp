#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

#include "montecarlo/integrators.h"
#include "tests/montecarlo/known_rooms.h"

// Ten million paths of every integrator, against what is known in closed form or to many digits: a bias of a thousandth
// shows in most, which the few thousand paths of other tests would not tell from noise.
namespace interflect::montecarlo {
namespace {

constexpr std::uint64_t samples = 10'000'000;  ///< of each measurement; of light tracing, of all of a scene together

test::KnownScene furnace() {
  test::KnownScene known{"furnace", test::random_room(test::furnace_wall(std::array{.2, .6}), {"a", "b"}, {}), {}};
  const scene::Scene& scene = known.scene;
  const auto wall = measure::patches_of(scene, test::surface_named(scene, "floor"), scene::Side::front);
  double area = 0;
  for (const scene::Facet& facet : scene.facets) area += facet.area;
  known.questions = {{test::all_fronts(scene), area * Spectrum(1), "all"},
                     {measure::PatchIrradiance{wall[0]}, Spectrum(1), "patch"},
                     {measure::PointIrradiance{scene.cameras[0].eye, Vec3(0, -.6, .8), {}}, Spectrum(1), "point"},
                     {measure::PixelRadiance{{0}, 5, 3}, inv_pi * Spectrum(1), "pixel"}};
  return known;
}

test::KnownScene sphere() {
  test::KnownScene known = test::sphere_of_varying_emission();
  for (const std::uint32_t s : {0u, 480u}) {
    known.questions.push_back(test::mirrored_pair(known.scene, scene::SurfaceId{s}));
  }
  return known;
}

test::KnownScene grey_cube() { return test::cube_with_one_emitting_face(.5); }
test::KnownScene bright_cube() { return test::cube_with_one_emitting_face(.8); }

using Making = test::KnownScene (*)();
constexpr std::array<Making, 5> scenes{furnace, sphere, grey_cube, bright_cube, test::penumbra_of_a_square};
constexpr std::array<const char*, 3> integrators{"path", "bidirectional", "light"};

/// One family: of all scenes, by all integrators.
std::size_t comparisons() {
  std::size_t of_scenes = 0;
  for (const Making make : scenes) {
    const test::KnownScene known = make();
    of_scenes += known.questions.size() * static_cast<std::size_t>(known.scene.channel_count());
  }
  return integrators.size() * of_scenes;
}

class KnownNumbers : public testing::TestWithParam<std::tuple<const char*, Making>> {};

// What is wrong by more than a few of the relative standard error `resolved` is found out.  Least known is a pair of
// 1280 facets by light tracing: of ten million paths, of two arrivals each, 31 000 meet it, which is .006 and a little
// more as what they carry varies.  Most others are below .001.
TEST_P(KnownNumbers, are_found_by_ten_million_paths) {
  constexpr double resolved = .007;
  const auto& [integrator, make] = GetParam();
  const test::KnownScene known = make();
  std::vector<measure::Measurement> asked;
  for (const test::Question& question : known.questions) asked.push_back(question.asked);
  IntegratorSettings settings;
  settings.samples = samples;
  core::LocalRun run(1);
  const auto found = make_integrator(integrator, settings)->answer(known.scene, asked, run.get());
  const double limit = test::critical_z(test::alpha, comparisons());
  double largest_z = 0, largest_noise = 0;
  for (std::size_t m = 0; m < asked.size(); ++m)
    for (int c = 0; c < known.scene.channel_count(); ++c) {
      const test::Question& question = known.questions[m];
      const double value = found[m].value[c], truth = question.truth[c];
      const double off = std::max(0.0, std::abs(value - truth) - question.slack), noise = found[m].standard_error[c];
      EXPECT_LE(off, limit * noise) << question.name << ", channel " << c << ": " << value << ", truth " << truth;
      if (truth == 0) continue;
      EXPECT_LT(noise, resolved * truth) << question.name << ", channel " << c;
      largest_z = std::max(largest_z, off / noise), largest_noise = std::max(largest_noise, noise / truth);
    }
  std::printf("%s, %s: largest z %.2f of %.2f, largest noise %.1e\n", known.name.c_str(), integrator, largest_z, limit,
              largest_noise);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, KnownNumbers,
                         testing::Combine(testing::ValuesIn(integrators), testing::ValuesIn(scenes)),
                         [](const auto& of) { return std::get<1>(of.param)().name + "_by_" + std::get<0>(of.param); });

}  // namespace
}  // namespace interflect::montecarlo
