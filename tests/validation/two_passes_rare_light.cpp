#include <gtest/gtest.h>

#include <cmath>

#include "fem/radiosity.h"
#include "fem/surface_solution.h"
#include "montecarlo/two_pass/two_pass.h"
#include "tests/montecarlo/rooms.h"

/// What a mirror throws of a small lamp onto what is measured, which the second pass meets by chance.
namespace interflect {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

/// H of a small square of exitance E that faces down, at a point that faces up: E A cos² / (pi d²).
double from_above(double power, const Vec3& way) {
  return power * way.z() * way.z() / (pi * way.squaredNorm() * way.squaredNorm());
}

}  // namespace

TEST(TwoPasses, allow_for_what_they_have_not_met_of_a_small_lamp) {
  const double side = 2e-3, exitance = 1e6;
  scene::SceneBuilder builder({"grey"});
  scene::Material mirror;
  mirror.name = "mirror", mirror.finish = scene::Mirror{test::grey(.8)};
  const auto grey = builder.add_material(test::diffuse("grey", 0, 0));
  builder.add_polygon("floor", test::parallelogram(Vec3::Zero(), x, y), grey);
  builder.add_polygon("wall", test::parallelogram(x, 2 * z, y), builder.add_material(mirror));
  builder.add_polygon("lamp", test::parallelogram(Vec3(.3, .5, 1.5), side * y, side * x),
                      builder.add_material(test::diffuse("lamp", 0, exitance)));
  const scene::Scene scene = builder.finish();
  const Vec3 point(.5, .5, .01), middle(.3 + side / 2, .5 + side / 2, 1.5), image(2 - middle.x(), middle.y(), 1.5);
  const double power = exitance * side * side,
               truth = from_above(power, middle - point) + .8 * from_above(power, image - point);

  fem::RadiositySettings elements;
  elements.element_size = .5;
  elements.form_factors = "hemisphere-rays";
  const measure::Measurement asked = measure::PointIrradiance{point, z, {}};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    core::LocalRun run(seed, 2);
    const fem::RadiositySolution solution = fem::solve_radiosity(scene, elements, run.get());
    const auto rays = raycast::make_ray_caster("embree", scene);
    const fem::MirroredLight mirrored = fem::mirrored_light(scene, solution, *rays, run.get());
    montecarlo::TwoPassSettings passes;
    passes.samples = 4096;
    passes.solution = fem::as_surface_solution(solution, mirrored);
    const Estimate found = montecarlo::TwoPass(passes).answer(scene, {&asked, 1}, run.get())[0];
    EXPECT_LE(std::abs(found.value[0] - truth), normal_95 * found.standard_error[0] + found.error_bound[0])
        << found.value[0] << " for " << truth;
    EXPECT_GE(found.standard_error[0], 3 * exitance / 4096 / 2) << "three finds, or half of that in case it was met";
  }
}

}  // namespace interflect
