// How fast errors of the path tracer fall with its samples, by each sample sequence: the slope of log RMSE on log n.
//
//   bench_convergence [picture.png]
//
// Mean irradiances: of a table by the light that comes straight from a point, a smooth integral of two dimensions; of a
// face of a cube by what the others reflect of such a point in its middle, four dimensions and smooth but at edges; and of
// the ceiling of a cube that its floor lights (data/scenes/cube.json), by all light: its paths have no last dimension and end
// by chance.  RMSE of 64 independent randomisations, 16 .. 16 384 samples each; slopes with 95 % intervals
// (core/convergence_slope.h).
#include <cstdio>
#include <string>

#include "core/convergence_slope.h"
#include "core/format.h"
#include "results/image_file.h"
#include "scene/reader.h"
#include "tests/support/randomised_means.h"
#include "visual/plot.h"

namespace {

using namespace interflect;

constexpr std::uint32_t randomisations = 64;
constexpr int last_power = 14;

void add_curves(const scene::Scene& scene, const std::string& surface, const std::string& panel,
                const measure::PathClasses& which, visual::Plot& plot) {
  const auto caster = raycast::make_ray_caster("embree", scene);
  const montecarlo::PathEstimator paths(scene, *caster, which);
  const montecarlo::MeasurementSampler sampler(scene, test::irradiance_of(scene, surface));
  const std::vector<std::uint64_t> samples = test::powers_of_two(last_power);
  std::printf("%s\n", panel.c_str());
  for (const std::string& sequence : core::sequence_names()) {
    const auto means = test::randomised_means(paths, sampler, sequence, samples, randomisations);
    const core::ConvergenceSlope found = core::convergence_slope(samples, means);
    std::printf("  %-16s slope %6.3f +- %.3f, RMSE of %llu samples %.3g W/m2\n", sequence.c_str(), found.slope,
                found.half_width(), static_cast<unsigned long long>(samples.back()), found.rmse.back());
    plot.curves.push_back(
        {core::format("%s: %.2f", sequence.c_str(), found.slope), {samples.begin(), samples.end()}, found.rmse, panel});
  }
}

}  // namespace

int main(int argc, char** argv) try {
  const scene::Scene cube = scene::read_scene(INTERFLECT_SOURCE_DIR "/data/scenes/cube.json");
  visual::Plot plot{"errors of the path tracer, and their slopes", "samples", "RMSE of mean irradiance [W/m2]", {}};
  add_curves(test::table_under_a_point(), "table", "table under a point: straight", measure::PathClasses::of("PE"),
             plot);
  add_curves(test::cube_about_a_point(), "cube/z+", "cube about a point: one reflection",
             measure::PathClasses::of("PDE"), plot);
  add_curves(cube, "ceiling", "cube lit by its floor: all light", measure::PathClasses::all(), plot);
  if (argc > 1) results::write_png(argv[1], visual::plot_picture(plot));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
