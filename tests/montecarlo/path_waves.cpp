#include "core/sample_sequence.h"
#include "montecarlo/measurement_sampler.h"
#include "tests/montecarlo/rooms.h"

// Paths that are traced together are what each is alone.
namespace interflect::montecarlo {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

void expect_each_as_alone(const scene::Scene& scene, const std::vector<measure::Measurement>& asked,
                          const std::string& intersector, const measure::PathClasses& which,
                          std::size_t given_each = 0) {
  const auto caster = raycast::make_ray_caster(intersector, scene);
  const PathEstimator paths(scene, *caster, which);
  for (std::uint32_t m = 0; m < asked.size(); ++m) {
    const MeasurementSampler sampler(scene, asked[m]);
    // In waves of different lengths: which paths go together does not matter.
    std::vector<Spectrum> together(2000), alone(together.size());
    std::vector<double> given(together.size() * given_each);
    if (given_each > 0) core::make_sequence("sobol-owen", 5)->points(0, given_each, given);
    const auto keys_from = [&](std::size_t first) -> PathEstimator::Keys {
      return {5, m, first, std::span(given).subspan(first * given_each), given_each};
    };
    for (std::size_t first = 0, length = 1; first < together.size(); first += length, length = 3 * length % 257 + 1)
      sampler.sample(paths, keys_from(first),
                     std::span(together).subspan(first, std::min(length, together.size() - first)));
    for (std::size_t k = 0; k < alone.size(); ++k) {
      core::RandomNumbers numbers(5, m, k, std::span(given).subspan(k * given_each, given_each));
      alone[k] = sampler.sample(paths, numbers);
    }
    int differ = 0;
    for (std::size_t k = 0; k < alone.size(); ++k) differ += together[k] != alone[k];
    EXPECT_EQ(differ, 0) << intersector << ", measurement " << m;
  }
}

TEST(PathWaves, are_what_each_path_is_alone) {
  const scene::Scene room = test::shiny();
  const std::vector<measure::Measurement> in_room{
      measure::Flux{measure::patches_of(room, test::surface_named(room, "room/z-"), scene::Side::front)},
      measure::PointIrradiance{Vec3(.3, 1, .4), Vec3(.6, 0, .8), {}}, measure::PixelRadiance{{0}, 1, 1}};
  const scene::Scene furnished = test::furnished(1), lit = test::lit_by_all();
  std::vector<measure::Measurement> in_furnished, in_lit;
  for (const scene::SurfaceId id : furnished.surface_ids())
    in_furnished.push_back(measure::Flux{measure::patches_of(furnished, id, scene::Side::front)});
  for (int k = 0; k < 4; ++k) in_furnished.push_back(measure::PixelRadiance{{0}, k + 1, k});
  for (const scene::SurfaceId id : lit.surface_ids())
    in_lit.push_back(measure::Flux{measure::patches_of(lit, id, scene::Side::front)});
  const auto all = measure::PathClasses::all();
  for (const char* intersector : {"embree", "brute"}) {
    expect_each_as_alone(room, in_room, intersector, all);
    expect_each_as_alone(room, in_room, intersector, measure::PathClasses::of("AS*DS*E"));
    expect_each_as_alone(furnished, in_furnished, intersector, all);
    expect_each_as_alone(lit, in_lit, intersector, all);
    // Numbers of a sequence, which end within a vertex.
    expect_each_as_alone(furnished, in_furnished, intersector, all, 2 + 8 + 2);
  }
}

}  // namespace
}  // namespace interflect::montecarlo
