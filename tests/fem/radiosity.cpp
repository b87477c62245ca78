#include "fem/radiosity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fem/closure.h"
#include "tests/fem/emitting_cube.h"
#include "tests/fem/rooms.h"
#include "tests/support/shapes.h"

namespace interflect::fem {
namespace {

using test::ceiling_id;
using test::cube;
using test::floor_id;
using test::mean_over;
using test::Room;
using test::solve;
using test::wall_id;

// docs/truths.md 2.6: exact discrete solutions, so that nothing is left but quadrature, at 1e-7, and the solver, at
// 1e-10.
TEST(Radiosity, of_the_cube_is_the_exact_discrete_solution) {
  struct Row {
    double rho;
    int n;
    double floor, ceiling, wall;
  };
  const Row rows[] = {{.5, 2, 1.099015809466, .173639114749, .181836268946},
                      {.5, 4, 1.102645712382, .171829422310, .181381216327},
                      {.8, 2, 1.572578202571, .668697021812, .689681193904},
                      {.8, 4, 1.582491239007, .663164443045, .688586079487}};
  for (const Row& row : rows) {
    const auto s = solve(cube(row.rho), {.element_size = 1.0 / row.n, .tolerance = 1e-7});
    ASSERT_EQ(s.mesh.size(), 6 * row.n * row.n);
    EXPECT_NEAR(mean_over(s, s.radiosity, floor_id), row.floor, 1e-8);
    EXPECT_NEAR(mean_over(s, s.radiosity, ceiling_id), row.ceiling, 1e-8);
    EXPECT_NEAR(mean_over(s, s.radiosity, wall_id), row.wall, 1e-8);
    if (row.n == 4) {  // the coarse system is the exact one of n = 2
      const Row& coarse = row.rho == .5 ? rows[0] : rows[2];
      EXPECT_NEAR(mean_over(s, s.coarse_radiosity, floor_id), coarse.floor, 1e-8);
      EXPECT_NEAR(mean_over(s, s.coarse_radiosity, ceiling_id), coarse.ceiling, 1e-8);
      EXPECT_NEAR(mean_over(s, s.coarse_radiosity, wall_id), coarse.wall, 1e-8);
    }
  }
}

// The sum over j of F_ij is 1 + d_i with |d_i| <= d, so B - 1 = (I - rho F)^-1 rho d is at most rho d / (1 - rho (1 +
// d)).
TEST(Radiosity, of_a_furnace_is_one_as_far_as_rows_sum_to_one) {
  for (double rho : {.2, .5, .8, .95}) {
    Room room;
    room.box({0, 0, 0}, {1, 2, 1.5}, 1, true, rho, 1 - rho);
    room.box({.25, .5, .5}, {.5, .5, .5}, 1, false, rho, 1 - rho);
    const auto s = solve(room.finish(), {.element_size = .5, .tolerance = 1e-3});
    EXPECT_TRUE(s.closed);
    double d = 0, worst = 0;
    for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
      d = std::max(d, std::abs(s.row_sum[i] - 1));
      worst = std::max(worst, std::abs(s.radiosity[i][0] - 1));
    }
    ASSERT_LT(rho * (1 + d), 1);
    EXPECT_LE(worst, d * rho / (1 - rho * (1 + d)) + 1e-8) << rho;
    EXPECT_LT(d, 0.05);
    EXPECT_NEAR(s.rows.mean, 1, 2e-3) << "no light is lost on the whole";
  }
}

/// A furnace with a body in it, so that visibility is sampled.
scene::Scene furnace(double rho) {
  Room room;
  room.box({0, 0, 0}, {1, 2, 1.5}, 1, true, rho, 1 - rho);
  room.box({.25, .5, .5}, {.5, .5, .5}, 1, false, rho, 1 - rho);
  return room.finish();
}

TEST(Radiosity, of_a_furnace_is_one_to_ten_digits_with_closure_restored) {
  for (const std::string& closure : closure_names())
    for (const double drop_below : {0.0, 2e-3})
      for (double rho : {.2, .5, .8, .95}) {
        RadiositySettings settings;
        settings.element_size = .5;
        settings.closure = closure;
        settings.drop_below = drop_below;
        settings.stopping.tolerance = 1e-13;
        core::LocalRun run(1, 2);
        const auto s = solve_radiosity(furnace(rho), settings, run.get());
        EXPECT_GT(s.closure_correction, 0);
        EXPECT_LT(s.closure_correction, 0.05);
        EXPECT_EQ(s.largest_dropped > 0, drop_below > 0);
        EXPECT_TRUE(s.environment.empty());
        for (const Spectrum& b : s.radiosity) EXPECT_NEAR(b[0], 1.0, 1e-10) << closure << " " << drop_below;
      }
}

// Pairs that are left out change the solution by no more than the estimate grows by: same K but for them.
TEST(Radiosity, says_what_dropped_pairs_may_do) {
  RadiositySettings settings;
  settings.element_size = .125;
  core::LocalRun run(1, 2);
  const auto scene = cube(.5);
  const auto all = solve_radiosity(scene, settings, run.get());
  EXPECT_EQ(all.kept_share, 1);
  for (const double drop_below : {1e-3, 3e-3}) {
    settings.drop_below = drop_below;
    const auto s = solve_radiosity(scene, settings, run.get());
    EXPECT_LT(s.kept_share, 0.95);
    EXPECT_LT(s.bytes, all.bytes);
    EXPECT_GT(s.mean_dropped, 0);
    EXPECT_LE(s.mean_dropped, s.largest_dropped);
    double difference = 0, grown = 0;
    for (std::size_t i = 0; i < s.irradiance.size(); ++i) {
      EXPECT_NEAR(s.row_sum[i], all.row_sum[i], s.largest_dropped + 1e-12);
      const double off = std::abs(s.irradiance[i][0] - all.irradiance[i][0]);
      EXPECT_LE(off, s.irradiance_error[i][0]) << drop_below;
      difference += off;
      grown += s.irradiance_error[i][0] - all.irradiance_error[i][0];
    }
    EXPECT_GT(difference, 0);
    EXPECT_LE(difference, grown) << drop_below;
  }
}

TEST(Radiosity, meets_a_tolerance_of_rows_and_says_so) {
  RadiositySettings settings;
  settings.element_size = .25;
  settings.form_factors = "analytic";
  core::LocalRun run(1, 2);
  for (const double tolerance : {1e-3, 1e-6}) {
    settings.row_tolerance = tolerance;
    const auto s = solve_radiosity(furnace(.5), settings, run.get());
    EXPECT_TRUE(s.tolerance_met);
    EXPECT_LE(s.largest_row_error, tolerance);
    for (const double sum : s.row_sum) EXPECT_NEAR(sum, 1, tolerance);
  }
  settings.form_factors = "hemicube";  // cannot be asked again
  settings.resolution = 16;
  EXPECT_FALSE(solve_radiosity(furnace(.5), settings, run.get()).tolerance_met);
}

// docs/truths.md 2.4: open, so nothing can be repaired.  Means over the plates, whose error falls as h².
TEST(Radiosity, of_parallel_squares_converges_with_order_two_to_the_exact_means) {
  const auto errors = [](double h) {
    Room room;
    const auto low = room.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, .3, 1),
               high = room.wall({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, 1, .7);
    const auto s = solve(room.finish(), {.element_size = h, .tolerance = 1e-6});
    EXPECT_FALSE(s.closed);
    return Vec2(mean_over(s, s.radiosity, low) - 1.008568960685, mean_over(s, s.radiosity, high) - 0.141092268875);
  };
  const Vec2 coarse = errors(1.0 / 4), fine = errors(1.0 / 8);
  for (Index k = 0; k < 2; ++k) {
    EXPECT_LT(std::abs(fine[k]), 2e-4);
    EXPECT_NEAR(std::log2(std::abs(coarse[k] / fine[k])), 2.0, 0.15);
  }
}

/// B on the facets of an icosphere for E = 1 + cos(theta) at their centroids, rho = 1/2.
struct SphereErrors {
  double moment;      ///< of sum A B cos(theta), relative
  double irradiance;  ///< root mean square of H - 2
  double field;       ///< largest |B_h - B| at corners
};
SphereErrors sphere_errors(int level) {
  scene::SceneBuilder builder({"y"});
  std::vector<scene::SurfacePatch> patches;
  for (const auto& triangle : interflect::test::icosphere(level, 1, true)) {
    const auto id = builder.add_facets("s", std::span(&triangle, 1), builder.add_material(test::diffuse(.5)));
    patches.push_back(scene::make_patch(id, scene::Side::front, triangle));
  }
  const auto n = static_cast<Index>(patches.size());
  const auto F = test::form_factors(builder.finish(), patches, 1e-4);
  EXPECT_EQ(F.pairs.sampled, 0u) << "a convex body is proved clear";
  Eigen::VectorXd E(n);
  Eigen::MatrixXd A = -0.5 * F.K;
  for (Index i = 0; i < n; ++i) {
    E[i] = 1 + patches[std::size_t(i)].centroid().normalized().z();
    A.row(i) /= patches[std::size_t(i)].area;
    A(i, i) += 1;
  }
  const Eigen::VectorXd B = A.partialPivLu().solve(E), H = 2 * (B - E);
  double moment = 0, squares = 0, area = 0, field = 0;
  for (Index i = 0; i < n; ++i) {
    const auto& patch = patches[std::size_t(i)];
    moment += patch.area * B[i] * (E[i] - 1);
    squares += patch.area * (H[i] - 2) * (H[i] - 2);
    area += patch.area;
    for (const Vec3& p : patch.ring()) field = std::max(field, std::abs(B[i] - (2 + p.normalized().z())));
  }
  return {std::abs(moment / (4 * pi / 3) - 1), std::sqrt(squares / area), field};
}

// docs/truths.md 2.1: inside a sphere the irradiance is the same everywhere, <E> / (1 - rho), whatever E: 2 for E = 1 +
// cos(theta) and rho = 1/2, so B = 2 + cos(theta).  (The area mean of H is exact for any facets, by the rows' sums.)  A
// weighted mean of B has order 2, by the facets' area; the field has order 1, by E; and so has H, facet by facet: a
// facet's normal goes through its circumcentre and not through its centroid.
TEST(Radiosity, in_a_sphere_converges_to_uniform_irradiance) {
  const SphereErrors a = sphere_errors(1), b = sphere_errors(2);
  EXPECT_NEAR(std::log2(a.moment / b.moment), 2.0, 0.2);
  EXPECT_NEAR(std::log2(a.field / b.field), 1.0, 0.1);
  EXPECT_GT(std::log2(a.irradiance / b.irradiance), 1.0);
  EXPECT_LT(b.irradiance, 0.01);
}

/// A room with a body in it, for comparisons under transformations: lengths are multiples of 1/8.
scene::Scene furnished(const std::function<Vec3(const Vec3&)>& move) {
  scene::SceneBuilder builder({"a", "b"});
  const auto wall = [&](const Vec3& corner, const Vec3& u, const Vec3& v, double rho, double exitance) {
    geometry::PlanarPolygon polygon = test::parallelogram(corner, u, v);
    for (Vec3& p : polygon.outer) p = move(p);
    scene::Material material = test::diffuse(rho, exitance);
    material.reflectance[1] = 0.5 * rho;
    builder.add_polygon("wall", polygon, builder.add_material(material));
  };
  wall({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, .3, 0);
  wall({0, 0, 1}, {0, 1, 0}, {2, 0, 0}, .8, 1);
  wall({0, 0, 0}, {0, 0, 1}, {2, 0, 0}, .6, 0);
  wall({0, 1, 0}, {2, 0, 0}, {0, 0, 1}, .6, 0);
  wall({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, .5, 0);
  wall({2, 0, 0}, {0, 0, 1}, {0, 1, 0}, .5, .25);
  wall({.5, .25, .5}, {.75, 0, 0}, {0, .5, 0}, .7, 0);    // a shelf: its upper side,
  wall({.5, .25, .375}, {0, .5, 0}, {.75, 0, 0}, .7, 0);  // its lower side
  return builder.finish();
}

void expect_same_radiosity(const RadiositySolution& a, const RadiositySolution& b, double relative) {
  ASSERT_EQ(a.radiosity.size(), b.radiosity.size());
  for (std::size_t i = 0; i < a.radiosity.size(); ++i)
    for (int c = 0; c < 2; ++c) EXPECT_NEAR(a.radiosity[i][c] / b.radiosity[i][c], 1.0, relative) << i;
}

// The same rays, so the same visibility but where one grazes an edge within rounding; none does for this seed.
// Adaptive quadrature may break a tie between equal errors differently, which moves an entry within its tolerance of
// 1e-3: 1e-6 of the radiosity here.
TEST(Radiosity, does_not_depend_on_the_unit_the_place_or_the_orientation) {
  const auto plain = solve(furnished([](const Vec3& p) { return p; }), {.element_size = .25, .tolerance = 1e-3});
  EXPECT_GT(plain.pairs.sampled, 100u);
  for (double scale : {1e-6, 1e6}) {
    const auto scaled = solve(furnished([&](const Vec3& p) -> Vec3 { return scale * p; }),
                              {.element_size = .25 * scale, .tolerance = 1e-3});
    expect_same_radiosity(scaled, plain, 1e-6);
  }
  const auto far = solve(furnished([](const Vec3& p) -> Vec3 { return p + Vec3(1e9, -1e9, 1e9); }),
                         {.element_size = .25, .tolerance = 1e-3});
  expect_same_radiosity(far, plain, 1e-6);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const auto turned = solve(furnished([&](const Vec3& p) -> Vec3 { return turn * p + Vec3(3, 4, 5); }),
                            {.element_size = .2500001, .tolerance = 1e-3});
  expect_same_radiosity(turned, plain, 1e-6);
}

TEST(Radiosity, is_the_same_to_the_last_bit_for_any_number_of_threads) {
  const auto scene = furnished([](const Vec3& p) { return p; });
  const auto one = solve(scene, {.element_size = .25, .threads = 1, .intersector = "embree"});
  for (unsigned threads : {2u, 3u, 8u}) {
    const auto many = solve(scene, {.element_size = .25, .threads = threads, .intersector = "embree"});
    EXPECT_EQ(many.radiosity, one.radiosity) << threads;
    EXPECT_EQ(many.irradiance_error, one.irradiance_error) << threads;
    EXPECT_EQ(many.irradiance_noise, one.irradiance_noise) << threads;
    EXPECT_EQ(many.row_sum, one.row_sum) << threads;
    EXPECT_EQ(many.energy.form_factor_error, one.energy.form_factor_error) << threads;
  }
}

// Elements of area 1 and 1/400 side by side: the swap of F_ij and F_ji would be off by that ratio.
TEST(Radiosity, balances_its_energy_with_very_unequal_elements) {
  Room room;
  room.box({0, 0, 0}, {2, 2, 2}, 1, true, .6);
  room.box({.9, .9, 0.5}, {.05, .05, .05}, 1, false, .4, 50);
  const auto s = solve(room.finish(), {.element_size = 1.0, .tolerance = 1e-4, .rays = 64});
  const EnergyBalance& e = s.energy;
  EXPECT_NEAR(e.emitted[0], 6 * .0025 * 50, 1e-12);
  EXPECT_EQ(e.escaped[0] + e.on_backs[0], 0.0);
  EXPECT_NEAR(e.absorbed[0] / e.emitted[0], 1.0, 0.02);
  EXPECT_NEAR((e.absorbed + e.escaped + e.on_backs + e.form_factor_error + e.residual)[0], e.emitted[0], 1e-12);
  EXPECT_LT(std::abs(e.residual[0]), 1e-7 * e.emitted[0]);
}

// What a black back swallows is found by rays and by row sums alike: 4.1 standard errors, alpha 1e-4 for both;
// quadrature and visibility noise in the row sums add their part.
TEST(Radiosity, finds_what_escapes_and_what_falls_on_backs) {
  Room room;
  room.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, .5, 1);
  room.wall({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 1, .5);  // flipped: its back faces the first
  const auto s = solve(room.finish(), {.element_size = .5});
  EXPECT_FALSE(s.closed);
  EXPECT_NEAR(s.energy.on_backs[0], 0.199824895698, 4.1 * s.energy.split_error[0]);
  EXPECT_NEAR(s.energy.escaped[0], 1 - 0.199824895698, 4.1 * s.energy.split_error[0]);
  EXPECT_NEAR(s.energy.absorbed[0], 0.0, 1e-12);
}

}  // namespace
}  // namespace interflect::fem
