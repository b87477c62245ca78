#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tests/fem/space/assembled_scene.h"

namespace interflect::fem {
namespace {

using test::AssembledScene;
using test::Room;

// Constants come back as constants, past what hides parts: sum_(j,0) K_(i,a),(j,0) = A_i for a = 0, and 0 for others.
TEST(RoomMoments, of_a_closed_room_with_bodies_send_constants_back) {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const int order : {1, 2}) {
      if (scale != 1 && order == 2) continue;
      Room room;
      room.box(Vec3(0, 0, 0), Vec3(5, 4, 3) * scale, 2);
      room.box(Vec3(1, 1, .2) * scale, Vec3(1, 1.5, 1.2) * scale, 1, false);
      room.box(Vec3(3, 2, .5) * scale, Vec3(1, .8, 1.1) * scale, 1, false);
      const double tolerance = order == 1 ? 1e-4 : 1e-3;
      const AssembledScene scene(room.finish(), room.patches, order, tolerance);
      const Index functions = scene.functions();
      for (Index i = 0; i < std::ssize(room.patches); ++i)
        for (Index a = 0; a < functions; ++a) {
          double sum = 0;
          for (Index j = 0; j < std::ssize(room.patches); ++j) sum += scene.K().entry(i * functions + a, j * functions);
          EXPECT_NEAR(sum / room.patches[std::size_t(i)].area, a == 0 ? 1 : 0, tolerance)
              << order << ' ' << i << ' ' << a;
        }
    }
}

// Unit squares one apart, rho = 0.5 both, the lower one emits 1: docs/truths.md 2.4.  Means converge with the order
// 2p + 2, and with them the iterated solution E + rho T B_h at every point.
TEST(RoomMoments, facing_squares_are_those_known_at_orders_that_grow_with_the_polynomials) {
  constexpr double mean_low = 1.010218055060, mean_high = .100947189239;
  for (const int order : {1, 2}) {
    std::vector<double> errors;
    for (const int n : {2, 4}) {
      Room room;
      const auto low = room.wall({-.5, -.5, 0}, {1, 0, 0}, {0, 1, 0}, n),
                 high = room.wall({-.5, -.5, 1}, {0, 1, 0}, {1, 0, 0}, n);
      AssembledScene squares(room.finish(), room.patches, order, 1e-10);
      const auto B = squares.solve([](scene::SurfaceId) { return .5; },
                                   [&](scene::SurfaceId id) { return id == low ? 1.0 : 0.0; });
      errors.push_back(std::abs(squares.mean(B, high) - mean_high));
      if (n < 4) continue;
      EXPECT_NEAR(squares.mean(B, low), mean_low, order == 1 ? 1e-6 : 1e-8);
      EXPECT_NEAR(squares.mean(B, high), mean_high, order == 1 ? 1e-6 : 1e-8);
      const Vec3 at[] = {{0, 0, 0}, {.25, .25, 0}, {.5, 0, 0}, {.5, .5, 0}};
      const double B_low[] = {1.012326762964, 1.010636247663, 1.009191215807, 1.007006348356},
                   B_high[] = {.120976802029, .104998409669, .091115016656, .069975044789};
      for (std::size_t k = 0; k < 4; ++k) {
        const double of_low = 1 + .5 * squares.irradiance(B, at[k], low),
                     of_high = .5 * squares.irradiance(B, at[k] + Vec3::UnitZ(), high);
        EXPECT_NEAR(of_low, B_low[k], order == 1 ? 1e-5 : 1e-6) << order << ' ' << k;
        EXPECT_NEAR(of_high, B_high[k], order == 1 ? 1e-5 : 1e-6) << order << ' ' << k;
      }
    }
    EXPECT_GT(std::log2(errors[0] / errors[1]), 2 * order + 1.6) << order << ": " << errors[0] << " -> " << errors[1];
  }
}

/// The unit cube's inside, n x n elements a wall that shrink towards the edges as (2k/n)^power.
struct Cube {
  Cube(int n, double power) {
    const auto line = [&](int k) {
      const double t = 2.0 * k / n;
      return t <= 1 ? 0.5 * std::pow(t, power) : 1 - 0.5 * std::pow(2 - t, power);
    };
    scene::SceneBuilder builder({"y"});
    const auto material = builder.add_material(test::diffuse(0));
    for (int axis = 0; axis < 3; ++axis)
      for (const bool high : {false, true}) {
        Vec3 u = Vec3::Zero(), v = u, corner = u;
        u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
        if (high) corner[axis] = 1, std::swap(u, v);
        walls.push_back(builder.add_polygon("wall", test::parallelogram(corner, u, v), material));
        for (int a = 0; a < n; ++a)
          for (int b = 0; b < n; ++b) {
            const auto at = [&](int i, int j) -> Vec3 { return corner + line(i) * u + line(j) * v; };
            const Vec3 ring[] = {at(a, b), at(a + 1, b), at(a + 1, b + 1), at(a, b + 1)};
            patches.push_back(scene::make_patch(walls.back(), scene::Side::front, ring));
          }
      }
    scene = builder.finish();
  }
  scene::Scene scene;
  std::vector<scene::SurfacePatch> patches;
  std::vector<scene::SurfaceId> walls;  ///< x-, x+, y-, y+, floor, ceiling
};

/// What means of the floor, which emits 1, the ceiling and a wall are off by, where rho = .8.
double off(const Cube& cube, int order, double tolerance, const std::array<double, 3>& known) {
  AssembledScene scene(cube.scene, cube.patches, order, tolerance);
  const auto B = scene.solve([](scene::SurfaceId) { return .8; },
                             [&](scene::SurfaceId id) { return id == cube.walls[4] ? 1.0 : 0.0; });
  return std::max({std::abs(scene.mean(B, cube.walls[4]) - known[0]), std::abs(scene.mean(B, cube.walls[5]) - known[1]),
                   std::abs(scene.mean(B, cube.walls[0]) - known[2])});
}

// docs/truths.md 2.6: means of the floor, the ceiling and a wall, of constants on n x n equal squares.
TEST(RoomMoments, of_constants_in_a_cube_are_the_exact_discrete_ones) {
  const std::map<int, std::array<double, 3>> known{{1, {1.551724153645, .689551070738, .689681193904}},
                                                   {2, {1.572578202571, .668697021812, .689681193904}},
                                                   {4, {1.582491239007, .663164443045, .688586079487}},
                                                   {8, {1.585938761118, .661579559373, .688120419877}}};
  for (const auto& [n, means] : known) EXPECT_LT(off(Cube(n, 1), 0, 1e-10, means), 1e-9) << n;
}

// Radiosity is rough along the edges: on equal elements no polynomials have their full order there, and where elements
// shrink towards them as their squares a few are enough.  Known to 2e-6.
TEST(RoomMoments, of_a_cube_converge_to_what_is_known) {
  constexpr std::array<double, 3> known{1.587505, .660979, .687879};
  const auto off_by = [&](double power, int order) { return off(Cube(6, power), order, 1e-5, known); };
  const double equal = off_by(1, 1), graded_1 = off_by(2, 1), graded_2 = off_by(2, 2);
  EXPECT_LT(graded_2, 5e-6);
  EXPECT_LT(graded_1, equal / 1.5) << "equal " << equal << ", graded " << graded_1;
  EXPECT_GT(equal, 10 * graded_2);
}

}  // namespace
}  // namespace interflect::fem
