#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <vector>

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

/// Unit squares one apart, the lower one of which emits 1, by their reflectances: means, and radiosities at (0, 0),
/// (.25, .25), (.5, 0), (.5, .5) from the middle.
struct FacingSquares {
  double rho_low, rho_high, mean_low, mean_high;
  std::array<double, 4> low, high;
};
// docs/truths.md 2.4.
constexpr std::array<FacingSquares, 2> facing_squares{
    {{.5,
      .5,
      1.010218055060,
      .100947189239,
      {1.012326762964, 1.010636247663, 1.009191215807, 1.007006348356},
      {.120976802029, .104998409669, .091115016656, .069975044789}},
     {.3,
      .7,
      1.008568960685,
      .141092268875,
      {1.010337339662, 1.008919660688, 1.007707844849, 1.005875595836},
      {.169085413687, .146754402664, .127350747221, .097804812116}}}};

// Means converge with the order 2p + 2, and with them the iterated solution E + rho T B_h at every point.
TEST(RoomMoments, facing_squares_are_those_known_at_orders_that_grow_with_the_polynomials) {
  for (const int order : {1, 2}) {
    std::array<std::vector<double>, facing_squares.size()> errors;
    for (const int n : {2, 4}) {
      Room room;
      const auto low = room.wall({-.5, -.5, 0}, {1, 0, 0}, {0, 1, 0}, n),
                 high = room.wall({-.5, -.5, 1}, {0, 1, 0}, {1, 0, 0}, n);
      AssembledScene squares(room.finish(), room.patches, order, 1e-10);
      for (std::size_t which = 0; which < facing_squares.size(); ++which) {
        const FacingSquares& known = facing_squares[which];
        const auto B = squares.solve([&](scene::SurfaceId id) { return id == low ? known.rho_low : known.rho_high; },
                                     [&](scene::SurfaceId id) { return id == low ? 1.0 : 0.0; });
        errors[which].push_back(std::abs(squares.mean(B, high) - known.mean_high));
        if (n < 4) continue;
        EXPECT_NEAR(squares.mean(B, low), known.mean_low, order == 1 ? 1e-6 : 1e-8) << known.rho_low;
        EXPECT_NEAR(squares.mean(B, high), known.mean_high, order == 1 ? 1e-6 : 1e-8) << known.rho_low;
        const Vec3 at[] = {{0, 0, 0}, {.25, .25, 0}, {.5, 0, 0}, {.5, .5, 0}};
        for (std::size_t k = 0; k < 4; ++k) {
          const double of_low = 1 + known.rho_low * squares.irradiance(B, at[k], low),
                       of_high = known.rho_high * squares.irradiance(B, at[k] + Vec3::UnitZ(), high);
          EXPECT_NEAR(of_low, known.low[k], order == 1 ? 1e-5 : 1e-6) << known.rho_low << ' ' << order << ' ' << k;
          EXPECT_NEAR(of_high, known.high[k], order == 1 ? 1e-5 : 1e-6) << known.rho_low << ' ' << order << ' ' << k;
        }
      }
    }
    for (std::size_t which = 0; which < facing_squares.size(); ++which)
      EXPECT_GT(std::log2(errors[which][0] / errors[which][1]), 2 * order + 1.6)
          << facing_squares[which].rho_low << ", " << order << ": " << errors[which][0] << " -> " << errors[which][1];
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

/// Mean radiosities of the floor, which emits 1, of the ceiling and of a wall.
struct CubeMeans {
  double rho;
  std::array<double, 3> means;
};

/// What each is off by at most.
std::vector<double> off(const Cube& cube, int order, double tolerance, std::span<const CubeMeans> known) {
  AssembledScene scene(cube.scene, cube.patches, order, tolerance);
  std::vector<double> off_by;
  for (const auto& [rho, means] : known) {
    const double reflected = rho;
    const auto B = scene.solve([&](scene::SurfaceId) { return reflected; },
                               [&](scene::SurfaceId id) { return id == cube.walls[4] ? 1.0 : 0.0; });
    off_by.push_back(
        std::max({std::abs(scene.mean(B, cube.walls[4]) - means[0]), std::abs(scene.mean(B, cube.walls[5]) - means[1]),
                  std::abs(scene.mean(B, cube.walls[0]) - means[2])}));
  }
  return off_by;
}

// docs/truths.md 2.6: means on n x n equal squares a wall.
TEST(RoomMoments, of_constants_in_a_cube_are_the_exact_discrete_ones) {
  const std::map<int, CubeMeans> known{{1, {.8, {1.551724153645, .689551070738, .689681193904}}},
                                       {2, {.8, {1.572578202571, .668697021812, .689681193904}}},
                                       {4, {.8, {1.582491239007, .663164443045, .688586079487}}},
                                       {8, {.8, {1.585938761118, .661579559373, .688120419877}}}};
  for (const auto& [n, means] : known) EXPECT_LT(off(Cube(n, 1), 0, 1e-10, {&means, 1})[0], 1e-9) << n;
}

// Radiosity is rough along the edges: on equal elements no polynomials have their full order there, and where elements
// shrink towards them as their squares a few are enough.  docs/truths.md 2.6: known to 5e-7 (rho = .5) and 2e-6 (.8).
TEST(RoomMoments, of_a_cube_converge_to_what_is_known) {
  constexpr std::array<CubeMeans, 2> known{{{.8, {1.587505, .660979, .687879}}, {.5, {1.1043615, .1712161, .1811056}}}};
  constexpr std::array<double, 2> accuracy{5e-6, 2e-6};  // 2.8e-6 and 1.3e-6 measured
  const auto off_by = [&](double power, int order) { return off(Cube(6, power), order, 1e-5, known); };
  const auto equal = off_by(1, 1), graded_1 = off_by(2, 1), graded_2 = off_by(2, 2);
  for (std::size_t k = 0; k < known.size(); ++k) {
    EXPECT_LT(graded_2[k], accuracy[k]) << known[k].rho;
    EXPECT_LT(graded_1[k], equal[k] / 1.5) << known[k].rho;
    EXPECT_GT(equal[k], 10 * graded_2[k]) << known[k].rho;
  }
}

}  // namespace
}  // namespace interflect::fem
