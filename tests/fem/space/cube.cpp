#include <gtest/gtest.h>

#include "tests/fem/space/assembled_scene.h"

namespace interflect::fem {
namespace {

/// Mean radiosities of the unit cube whose floor emits 1, of constants on n x n equal squares a face, one reflectance.
struct CubeMeans {
  int n;
  double rho, floor, ceiling, wall;
};

// docs/truths.md 2.6.  Nothing is left but form factors and the solver; rho = .8 up to n = 8 is in rooms.cpp.
TEST(CubeOfConstants, has_its_exact_discrete_means_up_to_sixteen_elements_a_side) {
  for (const CubeMeans& known : {CubeMeans{1, .5, 1.090909098108, .181745826108, .181836268946},
                                 {2, .5, 1.099015809466, .173639114749, .181836268946},
                                 {4, .5, 1.102645712382, .171829422310, .181381216327},
                                 {8, .5, 1.103844681651, .171373223526, .181195523706},
                                 {16, .5, 1.104210820983, .171255694053, .181133371241},
                                 {16, .8, 1.587035037726, .661138141882, .687956705098}}) {
    test::Room room;
    room.box(Vec3::Zero(), Vec3::Ones(), known.n);
    const scene::SurfaceId x_wall{0}, y_wall{2}, floor{4}, ceiling{5};
    test::AssembledScene cube(room.finish(), room.patches, 0, 1e-10);
    const auto B = cube.solve([&](scene::SurfaceId) { return known.rho; },
                              [&](scene::SurfaceId id) { return id == floor ? 1.0 : 0.0; });
    EXPECT_NEAR(cube.mean(B, floor), known.floor, 1e-9) << known.n << ' ' << known.rho;
    EXPECT_NEAR(cube.mean(B, ceiling), known.ceiling, 1e-9) << known.n << ' ' << known.rho;
    EXPECT_NEAR(cube.mean(B, x_wall), known.wall, 1e-9) << known.n << ' ' << known.rho;
    EXPECT_NEAR(cube.mean(B, y_wall), known.wall, 1e-9) << known.n << ' ' << known.rho;
  }
}

}  // namespace
}  // namespace interflect::fem
