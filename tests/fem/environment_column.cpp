#include "fem/environment_column.h"

#include <gtest/gtest.h>

#include "fem/assembly.h"
#include "fem/closure.h"
#include "fem/operator/dense_symmetric.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using test::Room;

/// The unit cube without its lid, n x n elements a wall (the box of Room has its ceiling last), and the elements' exact
/// F_i,env: what they would send to the lid, by the closed form.
struct OpenCube {
  explicit OpenCube(int n, double size = 1, const Vec3& low = Vec3::Zero()) {
    Room open, closed;
    for (Room* room : {&open, &closed}) {
      room->wall(low, {0, size, 0}, {0, 0, size}, n, .5);
      room->wall(low + Vec3(size, 0, 0), {0, 0, size}, {0, size, 0}, n, .5);
      room->wall(low, {0, 0, size}, {size, 0, 0}, n, .5);
      room->wall(low + Vec3(0, size, 0), {size, 0, 0}, {0, 0, size}, n, .5);
      room->wall(low, {size, 0, 0}, {0, size, 0}, n, .5);
    }
    patches = open.patches;
    closed.wall(low + Vec3(0, 0, size), {0, size, 0}, {size, 0, 0}, 1, .5);
    scene = std::make_unique<scene::Scene>(open.finish());
    rays = raycast::make_ray_caster("embree", *scene);
    const scene::Scene with_lid = closed.finish();
    const auto caster = raycast::make_ray_caster("embree", with_lid);
    const auto method = make_form_factor_method("analytic", {with_lid, closed.patches, *caster, 1, 1e-9});
    core::LocalRun run(1, 1);
    DenseSymmetric K(areas_of(closed.patches));
    assemble(*method, closed.patches, K, run);
    const auto lid = static_cast<Index>(patches.size());
    for (Index a = 0; a < lid; ++a) exact.push_back(K.entry(a, lid) / K.gram()[static_cast<std::size_t>(a)]);
    exact_K = Eigen::MatrixXd(lid, lid);
    for (Index a = 0; a < lid; ++a)
      for (Index b = 0; b < lid; ++b) exact_K(a, b) = K.entry(a, b);
  }
  static std::vector<double> areas_of(std::span<const scene::SurfacePatch> of) {
    std::vector<double> areas;
    for (const auto& patch : of) areas.push_back(patch.area);
    return areas;
  }

  std::unique_ptr<scene::Scene> scene;
  std::unique_ptr<raycast::RayCaster> rays;
  std::vector<scene::SurfacePatch> patches;
  std::vector<double> exact;
  Eigen::MatrixXd exact_K;
};

// docs/truths.md 2.9: the floor sends 0.19982489569838738 to the lid, a wall 0.20004377607540315.
TEST(EnvironmentColumn, of_a_cube_without_its_lid_is_the_closed_form) {
  const OpenCube cube(4);
  double floor = 0, wall = 0;
  for (std::size_t a = 0; a < 80; ++a) (a < 64 ? wall : floor) += cube.exact[a];
  EXPECT_NEAR(floor / 16, 0.19982489569838738, 1e-9);
  EXPECT_NEAR(wall / 64, 0.20004377607540315, 1e-9);
  core::LocalRun run(1, 2);
  const EnvironmentColumn column = cast_environment_column(*cube.scene, cube.patches, *cube.rays, 1296, run);
  double mean = 0, variance = 0, z2 = 0, largest = 0;
  for (std::size_t a = 0; a < 80; ++a) {
    const double z = (column.factor[a] - cube.exact[a]) / column.standard_error[a];
    z2 += z * z / 80;
    largest = std::max(largest, std::abs(z));
    mean += (column.factor[a] - cube.exact[a]) / 80;
    variance += std::pow(column.standard_error[a] / 80, 2);
    EXPECT_LT(column.standard_error[a], 0.75 * std::sqrt(0.25 / 1296)) << "strata pay";
  }
  // Errors are stated too large if anything: with alpha = 1e-3 for each of these, a mean of 80 chi-squares is
  // below 1.57, the largest of 80 normal numbers below 4.4, a normal number below 3.3.
  EXPECT_LT(z2, 1.57);
  EXPECT_LT(largest, 4.4);
  EXPECT_LT(std::abs(mean), 3.3 * std::sqrt(variance));
}

TEST(EnvironmentColumn, is_nothing_in_a_closed_box_and_all_of_a_lonely_plate) {
  core::LocalRun run(1, 2);
  Room box, plate;
  box.box({0, 0, 0}, {1, 2, 3}, 2);
  plate.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2);
  for (const auto& [room, factor] : {std::pair{&box, 0.0}, {&plate, 1.0}}) {
    const scene::Scene scene = room->finish();
    const auto rays = raycast::make_ray_caster("brute", scene);
    const EnvironmentColumn column = cast_environment_column(scene, room->patches, *rays, 256, run);
    for (const double f : column.factor) EXPECT_EQ(f, factor);
    for (const double e : column.standard_error) EXPECT_EQ(e, 2.0 / 256) << "an opening may lie between the rays";
  }
}

// A black back takes what a hole would: as energy balances and openness have it.
TEST(EnvironmentColumn, holds_what_falls_on_black_backs) {
  core::LocalRun run(1, 2);
  Room room;
  room.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);
  room.wall({-50, -50, 1}, {100, 0, 0}, {0, 100, 0}, 1);  // looks up, away from the first
  const scene::Scene scene = room.finish();
  const auto rays = raycast::make_ray_caster("embree", scene);
  for (const double f : cast_environment_column(scene, room.patches, *rays, 256, run).factor) EXPECT_EQ(f, 1);
}

TEST(EnvironmentColumn, is_the_same_for_any_number_of_threads_and_at_any_scale) {
  const OpenCube cube(3);
  core::LocalRun one(1, 1), several(1, 5), other(2, 1);
  const EnvironmentColumn column = cast_environment_column(*cube.scene, cube.patches, *cube.rays, 256, one);
  EXPECT_EQ(cast_environment_column(*cube.scene, cube.patches, *cube.rays, 256, several).factor, column.factor);
  EXPECT_NE(cast_environment_column(*cube.scene, cube.patches, *cube.rays, 256, other).factor, column.factor);
  for (const double size : {0x1p-20, 1e-6, 1e6}) {
    const OpenCube scaled(3, size);
    const EnvironmentColumn same = cast_environment_column(*scaled.scene, scaled.patches, *scaled.rays, 256, one);
    for (std::size_t a = 0; a < column.factor.size(); ++a)
      EXPECT_NEAR(same.factor[a], column.factor[a], 1.5 / 256) << size;
  }
}

// Form factors by rays and an environment by other rays: rows add up to 1 afterwards, and both are nearer to the closed
// form.
TEST(ClosureRepairs, bring_an_open_cube_nearer_to_its_closed_form) {
  const OpenCube cube(4);
  core::LocalRun run(1, 2);
  const auto n = static_cast<Index>(cube.patches.size());
  const EnvironmentColumn column = cast_environment_column(*cube.scene, cube.patches, *cube.rays, 1296, run);
  FormFactorContext context{*cube.scene, cube.patches, *cube.rays, 1, 1e-3};
  context.samples = 16384;
  const auto method = make_form_factor_method("hemisphere-rays", context);
  for (const std::string& name : closure_names()) {
    DenseSymmetric K(OpenCube::areas_of(cube.patches));
    assemble(*method, cube.patches, K, run);
    double K_before = 0, K_after = 0, env_before = 0, env_after = 0;
    const auto off = [&] {
      double sum = 0;
      for (Index a = 0; a < n; ++a)
        for (Index b = 0; b < n; ++b) sum += std::pow(K.entry(a, b) - cube.exact_K(a, b), 2);
      return std::sqrt(sum);
    };
    K_before = off();
    const ClosureReport report = restore_closure(K, run, {.method = name, .environment = &column});
    K_after = off();
    EXPECT_TRUE(report.converged);
    const std::vector<double> sums = K.row_sums(run);
    for (std::size_t a = 0; a < sums.size(); ++a) {
      EXPECT_NEAR(sums[a] + report.environment[a], 1, 1e-13);
      env_before += std::pow(column.factor[a] - cube.exact[a], 2);
      env_after += std::pow(report.environment[a] - cube.exact[a], 2);
    }
    EXPECT_LT(K_after, K_before) << name;
    EXPECT_LT(env_after, 0.9 * env_before) << name;
  }
}

// The environment's rays are noisier than exact entries by ten thousand times, and give way: entries stay where they
// were to within what they err.
TEST(ClosureRepairs, leave_exact_factors_of_an_open_scene_as_they_are) {
  const OpenCube cube(4);
  core::LocalRun run(1, 2);
  const auto n = static_cast<Index>(cube.patches.size());
  const EnvironmentColumn column = cast_environment_column(*cube.scene, cube.patches, *cube.rays, 1296, run);
  const std::vector<double> bound(static_cast<std::size_t>(n), 1e-8);
  for (const std::string& name : closure_names()) {
    DenseSymmetric K(OpenCube::areas_of(cube.patches));
    for (Index a = 0; a < n; ++a)
      for (Index b = a; b < n; ++b) K.add(a, b, {cube.exact_K(a, b), 0, 0});
    const ClosureReport report = restore_closure(K, run, {.method = name, .row_bound = bound, .environment = &column});
    EXPECT_TRUE(report.converged);
    EXPECT_GT(report.row_error_before, 1e-3) << "what the rays are off by";
    EXPECT_LT(report.correction, 1e-8) << name;
    for (std::size_t a = 0; a < cube.exact.size(); ++a) EXPECT_NEAR(report.environment[a], cube.exact[a], 1e-7) << name;
  }
}

// What obstacles without elements get is gone, too.
TEST(EnvironmentColumn, holds_what_falls_on_surfaces_without_elements) {
  core::LocalRun run(1, 2);
  Room room;
  room.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2);
  room.wall({-50, -50, 1}, {0, 100, 0}, {100, 0, 0}, 1);  // looks down
  const scene::Scene scene = room.finish();
  const auto rays = raycast::make_ray_caster("embree", scene);
  const std::span<const scene::SurfacePatch> floor = std::span(room.patches).first(4);
  const EnvironmentColumn all = cast_environment_column(scene, room.patches, *rays, 256, run);
  const EnvironmentColumn of_floor = cast_environment_column(scene, floor, *rays, 256, run);
  for (std::size_t a = 0; a < 4; ++a) {
    EXPECT_LT(all.factor[a], 0.01);
    EXPECT_EQ(of_floor.factor[a], 1);
  }
  EXPECT_FALSE(is_closed(of_floor));
}

/// A whole solve of an open scene: its rows and its environment add up to 1, and nothing is kept inside that would
/// leave, nor let out that would not: what was dropped, a tenth of the rows, is not taken for an opening.
TEST(ClosureRepairs, of_an_open_scene_keep_its_energy_in_balance) {
  for (const std::string& name : closure_names())
    for (const double drop_below : {0.0, 2.2e-3}) {
      Room room;
      room.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, .3, 1);
      room.wall({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, 1, .7);
      RadiositySettings settings;
      settings.element_size = .125;
      settings.closure = name;
      settings.drop_below = drop_below;
      core::LocalRun run(1, 2);
      const RadiositySolution s = solve_radiosity(room.finish(), settings, run.get());
      EXPECT_FALSE(s.closed);
      EXPECT_EQ(s.mean_dropped > 0.01, drop_below > 0);
      ASSERT_EQ(s.environment.size(), s.row_sum.size());
      for (std::size_t i = 0; i < s.environment.size(); ++i) EXPECT_NEAR(s.row_sum[i] + s.environment[i], 1, 1e-12);
      // docs/truths.md 2.4: 0.8001751 of what a plate sends leaves.
      EXPECT_NEAR(mean_environment(s), 1 - 0.19982489569838738, 1e-3);
      EXPECT_NEAR(test::mean_over(s, s.radiosity, scene::SurfaceId{0}), 1.008568960685, 1e-3);
      EXPECT_NEAR(test::mean_over(s, s.radiosity, scene::SurfaceId{1}), 0.141092268875, 1e-3);
    }
}

}  // namespace
}  // namespace interflect::fem
