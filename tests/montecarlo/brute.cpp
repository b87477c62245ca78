#include <algorithm>

#include "tests/montecarlo/both_casters.h"
#include "tests/montecarlo/solution_rooms.h"
#include "tests/montecarlo/statistics.h"

// Rays that meet facets in single precision, by Embree, and in double, one after the other: by the same numbers every
// integrator of the catalogue gives the same answers, but for few (both_casters.h).  And neither caster may see more
// than the other: their differences are zero in the mean, whatever they are.
namespace interflect::montecarlo {
namespace {

using test::Compared;

constexpr std::size_t tails_of_a_scene = 3;

/// Patches and points, each asked again and again, and all pixels.
struct Asked {
  std::vector<measure::Measurement> all;
  Asked(const scene::Scene& scene, double scale, int times) {
    for (int k = 0; k < times; ++k) {
      for (const scene::SurfaceId id : scene.surface_ids())
        all.emplace_back(measure::Flux{measure::patches_of(scene, id, scene::Side::front)});
      all.emplace_back(measure::PointIrradiance{scale * Vec3(.5, 1, .4), Vec3(.6, 0, .8), {}});
      all.emplace_back(measure::PointIrradiance{scale * Vec3(1.75, 1, .1), Vec3::UnitZ(), {}});
    }
    for (std::uint32_t c = 0; c < scene.cameras.size(); ++c)
      for (int y = 0; y < scene.cameras[c].height; ++y)
        for (int x = 0; x < scene.cameras[c].width; ++x) all.emplace_back(measure::PixelRadiance{{c}, x, y});
  }
};

class ByBothCasters : public testing::TestWithParam<std::string> {
 protected:
  /// As few as find something: where lamps are met by chance and paths are shared, more.
  std::uint64_t samples() const {
    if (GetParam() == "light") return 500;
    return GetParam() == "whitted" || GetParam() == "unidirectional" ? 32 : 2;
  }
  std::vector<Estimate> answers(const scene::Scene& scene, const std::vector<measure::Measurement>& asked,
                                const char* intersector, std::uint64_t seed = 1) const {
    IntegratorSettings settings;
    settings.samples = samples();
    settings.intersector = intersector;
    settings.paths = test::paths_found(GetParam(), asked);
    settings.solution = test::says_everywhere(Spectrum(2));
    core::LocalRun run(seed, 2);
    return make_integrator(GetParam(), settings)->answer(scene, asked, run.get());
  }

  void expect_same(const char* name, const scene::Scene& scene, test::Family& family, double scale = 1,
                   int times = 10) const {
    const Asked asked(scene, scale, times);
    const Compared by_both(answers(scene, asked.all, "embree"), answers(scene, asked.all, "brute"),
                           scene.channel_count());
    const core::ScalarMoments& differences = by_both.differences;
    test::expect_few_others(by_both, family, name);
    EXPECT_LE(std::abs(differences.mean()), family.z() * differences.standard_error()) << name;
  }
};

TEST_P(ByBothCasters, gives_the_same_answers_in_a_furnished_room_of_any_size) {
  test::Family family(3 * tails_of_a_scene);
  for (const double scale : {1., 1e-6, 1e6}) expect_same("furnished", test::furnished(scale), family, scale);
}

TEST_P(ByBothCasters, gives_the_same_answers_beside_every_material) {
  const bool is_two_pass = GetParam() == "two-pass";
  test::Family family(tails_of_a_scene);
  expect_same("materials", is_two_pass ? test::known_to_two_passes() : test::shiny(), family, 1, is_two_pass ? 1 : 5);
}

// Two passes know lamps alone.
TEST_P(ByBothCasters, gives_the_same_answers_by_lights_of_every_kind) {
  if (GetParam() == "two-pass") return;
  scene::Scene scene = test::lit_by_all();
  scene.cameras.push_back(
      {"c", Vec3(.2, .9, .5), Vec3(2.2, 1, .35), Vec3::UnitZ(), scene::Projection(scene::Pinhole{80}), 6, 6});
  test::Family family(tails_of_a_scene);
  expect_same("lights", scene, family);
}

// Other paths are no such few that meet edges.  Whitted's trees have no chance.
TEST_P(ByBothCasters, are_told_from_other_paths) {
  if (GetParam() == "whitted") return;
  const scene::Scene scene = test::furnished(1);
  const Asked asked(scene, 1, 10);
  const Compared by_seeds(answers(scene, asked.all, "embree"), answers(scene, asked.all, "embree", 2),
                          scene.channel_count());
  EXPECT_GT(by_seeds.others, 10 * test::share_of_others * by_seeds.all());
}

INSTANTIATE_TEST_SUITE_P(Catalogue, ByBothCasters, testing::ValuesIn(integrator_names()), [](const auto& of) {
  std::string name = of.param;
  std::ranges::replace(name, '-', '_');
  return name;
});

}  // namespace
}  // namespace interflect::montecarlo
