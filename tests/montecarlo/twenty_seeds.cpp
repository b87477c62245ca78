#include <gtest/gtest.h>

#include <cmath>

#include "core/moments.h"
#include "core/student_t.h"
#include "montecarlo/integrators.h"
#include "montecarlo/scene_paths.h"
#include "scene/reader.h"
#include "tests/montecarlo/rooms.h"

/// Unbiased integrators on what each two of them find, over 20 seeds: whatever their own errors are worth, the means of
/// their differences are 0, within what seeds scatter.
namespace interflect::montecarlo {
namespace {

constexpr int seeds = 20;
constexpr double alpha = 1e-3;  ///< of a scene

struct Asked {
  std::string name;
  std::uint64_t samples;  ///< a measurement, or of all together where paths are shared
};

/// Mean differences of two integrators, [measurement * channels + channel].
std::vector<core::ScalarMoments> differences(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                             const Asked& a, const Asked& b) {
  const auto finds = [&](const Asked& each) {
    return make_integrator(each.name, {})->capabilities().paths_to(asked[0]);
  };
  IntegratorSettings settings;
  settings.paths = finds(a) & finds(b);
  const auto channels = static_cast<std::size_t>(scene.channel_count());
  std::vector<core::ScalarMoments> all(asked.size() * channels);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    core::LocalRun run(seed, 2);
    settings.samples = a.samples;
    const auto of_a = make_integrator(a.name, settings)->answer(scene, asked, run.get());
    settings.samples = b.samples;
    const auto of_b = make_integrator(b.name, settings)->answer(scene, asked, run.get());
    for (std::size_t m = 0; m < asked.size(); ++m)
      for (std::size_t c = 0; c < channels; ++c)
        all[m * channels + c].add((of_a[m].value - of_b[m].value)[static_cast<int>(c)] /
                                  of_b[m].value[static_cast<int>(c)]);
  }
  return all;
}

/// @param resolved  relative standard error of the means, which the first of what is asked has to be below
void expect_agreement(const scene::Scene& scene, const std::vector<measure::Measurement>& asked,
                      const std::vector<Asked>& integrators, double resolved) {
  const std::size_t pairs = integrators.size() * (integrators.size() - 1) / 2;
  const auto comparisons = static_cast<double>(pairs * asked.size() * static_cast<std::size_t>(scene.channel_count()));
  const double t = core::student_t(std::pow(1 - alpha, 1 / comparisons), seeds - 1);
  for (std::size_t a = 0; a < integrators.size(); ++a)
    for (std::size_t b = a + 1; b < integrators.size(); ++b) {
      const std::string both = integrators[a].name + " - " + integrators[b].name;
      const auto found = differences(scene, asked, integrators[a], integrators[b]);
      for (std::size_t k = 0; k < found.size(); ++k)
        EXPECT_LE(std::abs(found[k].mean()), t * found[k].standard_error()) << both << ", " << k;
      EXPECT_LT(found[0].standard_error(), resolved) << both;
    }
}

/// All fronts together, and each of a few surfaces.
std::vector<measure::Measurement> fluxes(const scene::Scene& scene, std::size_t every) {
  std::vector<measure::Measurement> asked{test::all_fronts(scene)};
  const auto ids = scene.surface_ids();
  for (std::size_t k = 0; k < ids.size(); k += every)
    asked.push_back(measure::Flux{measure::patches_of(scene, ids[k], scene::Side::front)});
  return asked;
}

std::vector<measure::Measurement> pixels(const scene::Scene& scene) {
  std::vector<measure::Measurement> asked;
  for (int y = 0; y < scene.camera({0}).height; ++y)
    for (int x = 0; x < scene.camera({0}).width; ++x) asked.push_back(measure::PixelRadiance{{0}, x, y});
  return asked;
}

TEST(TwentySeeds, of_a_room_with_every_material_and_small_lamps) {
  const scene::Scene scene = test::shiny();
  expect_agreement(scene, fluxes(scene, 5), {{"path", 3000}, {"bidirectional", 1500}, {"light", 20000}}, .02);
}

TEST(TwentySeeds, of_pixels_of_that_room) {
  const scene::Scene scene = test::shiny();
  expect_agreement(scene, pixels(scene), {{"path", 2000}, {"bidirectional", 700}, {"light", 20000}}, .2);
}

TEST(TwentySeeds, of_every_kind_of_light) {
  const scene::Scene scene = test::lit_by_all();
  expect_agreement(scene, test::all_of_lit(scene), {{"path", 8000}, {"bidirectional", 4000}, {"light", 80000}}, .01);
}

TEST(TwentySeeds, of_two_rooms_with_a_door_ajar) {
  const scene::Scene scene = scene::read_scene(INTERFLECT_SOURCE_DIR "/data/scenes/two_rooms.json");
  expect_agreement(scene, fluxes(scene, 4), {{"path", 8000}, {"bidirectional", 4000}, {"light", 80000}}, .005);
}

}  // namespace
}  // namespace interflect::montecarlo
