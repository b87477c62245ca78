#include "core/convergence_slope.h"
#include "tests/montecarlo/rooms.h"
#include "tests/support/randomised_means.h"

// How fast errors of path-traced irradiances fall with samples.
namespace interflect::test {
namespace {

constexpr std::uint32_t randomisations = 32;
const measure::PathClasses all = measure::PathClasses::all();

core::ConvergenceSlope slope_by(const std::string& sequence, const scene::Scene& scene, const std::string& surface,
                                const measure::PathClasses& which) {
  const auto caster = raycast::make_ray_caster("embree", scene);
  const montecarlo::PathEstimator paths(scene, *caster, which);
  const montecarlo::MeasurementSampler sampler(scene, irradiance_of(scene, surface));
  const auto samples = powers_of_two(12);
  return core::convergence_slope(samples, randomised_means(paths, sampler, sequence, samples, randomisations));
}

void expect_one_half(const core::ConvergenceSlope& found, double confidence) {
  EXPECT_LE(std::abs(found.slope + 0.5), found.half_width(confidence)) << found.slope;
  EXPECT_LT(found.half_width(confidence), 0.15);  // a longer interval would tell nothing
}

// Two comparisons, of the family's alpha half each.
TEST(Convergence, of_independent_samples_is_of_order_one_half) {
  expect_one_half(slope_by("independent", table_under_a_point(), "table", all), 1 - alpha / 2);
  expect_one_half(slope_by("independent", facing_squares(), "upper", all), 1 - alpha / 2);
}

// Below -1/2 with the upper end of a one-sided interval: four comparisons, of the family's alpha a fourth each.  Straight
// from a point light is a smooth function of the place alone, two dimensions of one net, whose errors fall nearly by n^-1.5.
TEST(Convergence, of_nets_is_steeper_where_light_is_smooth) {
  const auto straight = measure::PathClasses::of("PE");
  for (const char* sequence : {"sobol", "sobol-owen", "zero-two", "halton"}) {
    const core::ConvergenceSlope found = slope_by(sequence, table_under_a_point(), "table", straight);
    EXPECT_LT(found.slope + found.half_width(1 - 2 * alpha / 4), -0.5) << sequence << ": " << found.slope;
  }
}

}  // namespace
}  // namespace interflect::test
