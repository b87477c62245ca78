#include <gtest/gtest.h>

#include "core/format.h"
#include "fem/radiosity.h"
#include "fem/surface_solution.h"
#include "montecarlo/controlled/controlled.h"
#include "montecarlo/two_pass/two_pass.h"
#include "tests/montecarlo/both_casters.h"
#include "tests/montecarlo/solution_rooms.h"

/// Radiosity and paths together, all by rays in double precision.  (By the same solution, and of all integrators:
/// tests/montecarlo/brute.cpp.)
namespace interflect {
namespace {

/// Both passes by one caster.
template <class Method, class Settings>
std::vector<Estimate> answers(const scene::Scene& scene, const std::vector<measure::Measurement>& asked, double scale,
                              const char* intersector) {
  fem::RadiositySettings first;
  first.element_size = scale;
  first.rough_is_black = true;
  first.intersector = intersector;
  core::LocalRun run(4, 2);
  const fem::RadiositySolution solution = fem::solve_radiosity(scene, first, run.get());
  const auto rays = raycast::make_ray_caster(intersector, scene);
  const fem::MirroredLight mirrored = fem::mirrored_light(scene, solution, *rays, run.get());
  Settings second;
  second.samples = 200;
  second.intersector = intersector;
  second.solution = fem::as_surface_solution(solution, mirrored);
  return Method(second).answer(scene, asked, run.get());
}

/// By the same numbers: but for few, both_casters.h.
template <class Method, class Settings>
void expect_same(const scene::Scene& scene, const std::vector<measure::Measurement>& asked, double scale,
                 test::Family& family) {
  const test::Compared by_both(answers<Method, Settings>(scene, asked, scale, "embree"),
                               answers<Method, Settings>(scene, asked, scale, "brute"), scene.channel_count());
  test::expect_few_others(by_both, family, core::format("%g", scale));
}

template <class Method, class Settings>
void expect_same_in_all_rooms() {
  test::Family family(3);
  for (const double scale : {1e-6, 1e6}) {
    const scene::Scene scene = test::furnished(scale);
    expect_same<Method, Settings>(scene, test::all_of_furnished(scene, scale), scale, family);
  }
  const scene::Scene scene = test::known_to_two_passes();
  std::vector<measure::Measurement> asked;
  for (const scene::SurfaceId id : scene.surface_ids())
    if (scene.surface(id).name.starts_with("room"))
      asked.emplace_back(measure::Flux{measure::patches_of(scene, id, scene::Side::front)});
  for (int k = 0; k < 24; k += 3) asked.emplace_back(measure::PixelRadiance{{0}, k % 6, k / 6});
  expect_same<Method, Settings>(scene, asked, 1, family);
}

TEST(ByBothCasters, two_passes_give_the_same) {
  expect_same_in_all_rooms<montecarlo::TwoPass, montecarlo::TwoPassSettings>();
}

TEST(ByBothCasters, controlled_paths_give_the_same) {
  expect_same_in_all_rooms<montecarlo::Controlled, montecarlo::ControlledSettings>();
}

}  // namespace
}  // namespace interflect
