#include <gtest/gtest.h>

#include "fem/goal/adaptive_elements.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using test::Room;

// The cube's floor emits 1; mean radiosities of floor, ceiling and a wall are known to 5e-7 (rho = 0.5) and 2e-6 (0.8)
// by graded meshes and extrapolation.
TEST(AdaptiveElements, find_the_limit_of_the_cube) {
  struct Known {
    double rho, floor, ceiling, wall, uncertainty;
  };
  for (const Known& known : {Known{.5, 1.1043615, .1712161, .1811056, 5e-7}, {.8, 1.587505, .660979, .687879, 2e-6}}) {
    Room room;
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    const auto floor = room.wall(Vec3::Zero(), x, y, 1, known.rho, 1), ceiling = room.wall(z, y, x, 1, known.rho),
               wall = room.wall(Vec3::Zero(), y, z, 1, known.rho);
    room.wall(x, z, y, 1, known.rho);
    room.wall(Vec3::Zero(), z, x, 1, known.rho);
    room.wall(y, x, z, 1, known.rho);
    const scene::Scene scene = room.finish();
    const auto rays = raycast::make_ray_caster("embree", scene);
    core::LocalRun run(1, 2);
    RadiositySettings settings;
    settings.order = 2;
    settings.form_factors = "analytic";
    settings.quadrature_tolerance = 1e-6;
    settings.element_size = .5;
    const auto expect = [&](scene::SurfaceId side, double radiosity, double exitance) {
      const Goal goal{"side", Goal::OnSurface{side, scene::Side::front}};
      const AdaptedElements made = adapt_elements(scene, settings, {goal, 5e-6}, *rays, run.get());
      EXPECT_EQ(made.adaptation.why, AdaptiveStop::met);
      const AdaptivePass& last = made.adaptation.passes.back();
      const double off = exitance + known.rho * last.value[0] - radiosity, bound = known.rho * last.error[0];
      EXPECT_LT(std::abs(off), bound + known.uncertainty) << last.elements;
      EXPECT_LT(bound, 5e-6);
    };
    expect(floor, known.floor, 1);
    expect(ceiling, known.ceiling, 0);
    expect(wall, known.wall, 0);
  }
}

}  // namespace
}  // namespace interflect::fem
