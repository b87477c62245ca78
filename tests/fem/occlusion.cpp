#include <gtest/gtest.h>

#include <cmath>

#include "fem/form_factor/blockers.h"
#include "fem/form_factor/element_clusters.h"
#include "fem/form_factor/visibility.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using test::form_factors;
using test::Room;

/// Unit squares one metre apart, n x n elements each, and a screen of half the side between them.
Room plates_with_screen(int n, const Vec3& screen_corner) {
  Room room;
  room.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, n);
  room.wall({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, n);
  room.screen(screen_corner, {.5, 0, 0}, {0, .5, 0});
  return room;
}

struct Sum {
  double value, error;
};
/// F from the first half of the elements to the others: the sum and its standard error, errors of entries being
/// independent.
Sum exchange_between_halves(const test::Assembled& F) {
  const Index n = F.K.rows() / 2;
  return {F.K.topRightCorner(n, n).sum(), std::sqrt(F.error.topRightCorner(n, n).squaredNorm())};
}

// docs/truths.md 2.11, V6 and V7, for one pair and for 256; four two-sided tests, alpha 1e-4 together: 4.1 standard
// errors. (The standard error is cautious, so that the true level is lower.)
TEST(Occlusion, form_factors_past_a_screen_agree_with_the_exact_ones) {
  for (int n : {1, 4})
    for (const auto& [corner, exact] :
         {std::pair(Vec3(0, 0, .5), 0.149868671774), std::pair(Vec3(.25, .25, .5), 0.099506294599)}) {
      Room room = plates_with_screen(n, corner);
      const auto scene = room.finish();
      const auto F = form_factors(scene, room.patches, 1e-6, n == 1 ? 1024 : 64);
      const Sum sum = exchange_between_halves(F);
      EXPECT_GT(F.pairs.sampled, 0u);
      EXPECT_NEAR(sum.value, exact, 4.1 * sum.error);
      EXPECT_LT(sum.error, 0.01 * exact) << "too much noise to mean anything";
    }
}

// docs/truths.md 2.11, V5: cubes of sides 3 and 1, F(out,out) = 8/9, F(out,in) = 1/9, F(in,out) = 1.  The inner cube's
// share needs no rays.
TEST(Occlusion, concentric_cubes_see_each_other_as_any_convex_bodies_do) {
  Room room;
  room.box({-1.5, -1.5, -1.5}, {3, 3, 3}, 4);
  room.box({-.5, -.5, -.5}, {1, 1, 1}, 2, false);
  const auto scene = room.finish();
  const auto F = form_factors(scene, room.patches, 1e-5, 64);
  const Index outer = 96, inner = 24;
  const double out_in = F.K.topRightCorner(outer, inner).sum() / 54,
               out_out = F.K.topLeftCorner(outer, outer).sum() / 54;
  const double error = std::sqrt(2 * F.error.topLeftCorner(outer, outer).squaredNorm()) / 54;  // each pair counts twice
  EXPECT_NEAR(out_in, 1.0 / 9, 1e-5);
  EXPECT_NEAR(out_out, 8.0 / 9, 4 * error);
  EXPECT_LT(error, 3e-3);
  for (Index i = outer; i < outer + inner; ++i)
    EXPECT_NEAR(F.K.row(i).sum() / .25, 1.0, 1e-5) << "the inner cube sees no noise";
}

// A screen in the middle of the room between two of its walls: each pair's deviation from a reference of 64 times as
// many rays, in standard errors.  Cautious: stratification gains, and agreeing rays are not taken for certainty.
TEST(Occlusion, standard_errors_of_visibility_are_honest) {
  Room room = plates_with_screen(6, {.25, .25, .5});
  const auto scene = room.finish();
  const auto caster = raycast::make_ray_caster("brute", scene);
  const VisibilitySampler sampler(room.patches, *caster, 16, 5), reference(room.patches, *caster, 1024, 6);
  VisibilitySampler::Workspace workspace;
  double squares = 0;
  int pairs = 0, beyond_3 = 0;
  for (Index i = 0; i < 36; ++i)
    for (Index j = 36; j < 72; ++j) {
      const SampledVisibility exact = reference(i, j, Effort::single, workspace);
      if (exact.visible == 0 || exact.visible == 1) continue;
      const SampledVisibility v = sampler(i, j, Effort::single, workspace);
      const double z = (v.visible - exact.visible) / std::hypot(v.standard_error, exact.standard_error);
      squares += z * z;
      ++pairs;
      beyond_3 += std::abs(z) > 3;
      EXPECT_GE(v.visible, 0);
      EXPECT_LE(v.visible, 1);
    }
  ASSERT_GT(pairs, 300);
  EXPECT_GT(std::sqrt(squares / pairs), 0.35) << "noise is far below what is said";
  EXPECT_LT(std::sqrt(squares / pairs), 1.05) << "noise is above what is said";
  EXPECT_LE(beyond_3, pairs / 100);
}

// Whatever the pair: rays are added until the stated error is the one asked for, and deviations from exact occlusion
// are no larger.  Deviations of pairs that share a wall's elements are nearly independent; their mean is held to five
// standard errors of as many.
TEST(Occlusion, rays_are_added_up_to_the_error_that_is_asked_for) {
  Room room = plates_with_screen(4, {.3, .15, .45});
  const auto scene = room.finish();
  const auto caster = raycast::make_ray_caster("embree", scene);
  const PairIntegrator unoccluded(room.patches, 1e-7);
  test::MatrixSink exact(room.patches.size());
  core::LocalRun run(1, 1);
  const ElementBlock all{room.patches, 0, std::ssize(room.patches)};
  make_form_factor_method("analytic", {scene, room.patches, *caster, 1, 1e-7})->exchange(all, all, exact, run.get());
  for (const double asked : {.05, .01}) {
    const VisibilitySampler sampler(room.patches, *caster, 4, 11, asked);
    VisibilitySampler::Workspace workspace;
    double sum = 0, squares = 0, rays = 0;
    int pairs = 0;
    for (Index i = 0; i < 16; ++i)
      for (Index j = 16; j < 32; ++j) {
        const SampledVisibility v = sampler(i, j, Effort::single, workspace);
        EXPECT_LE(v.standard_error, asked) << i << ' ' << j;
        EXPECT_EQ(v.rays, std::ssize(workspace.segments));
        const double V = exact.K(i, j) / unoccluded(i, j).value;
        if (V < 1e-6 || V > 1 - 1e-6) continue;
        const double z = (v.visible - V) / asked;
        sum += z, squares += z * z, rays += v.rays, ++pairs;
      }
    ASSERT_GT(pairs, 100);
    EXPECT_LT(std::sqrt(squares / pairs), 1.05) << asked;
    EXPECT_GT(std::sqrt(squares / pairs), .3) << "more rays than it takes";
    EXPECT_LT(std::abs(sum) / pairs, 5 / std::sqrt(pairs)) << asked;
    EXPECT_LT(rays / pairs, 1.5 * .25 / (asked * asked) + 256) << "V (1 - V) / s², of which sets of 64 are made";
  }
}

// A leak would show here: nothing passes a wall.
TEST(Occlusion, a_wall_between_two_rooms_lets_nothing_through) {
  Room room;
  room.box({0, 0, 0}, {1, 1, 1}, 2);
  room.box({1, 0, 0}, {1, 1, 1}, 2);
  const auto scene = room.finish();
  const auto F = form_factors(scene, room.patches, 1e-5);
  EXPECT_EQ(F.K.topRightCorner(24, 24).maxCoeff(), 0.0);
}

// The same numbers from the whole matrix at once, and from blocks of any size.
TEST(Occlusion, entries_do_not_depend_on_the_blocks_they_are_asked_in) {
  Room room = plates_with_screen(5, {.25, .25, .5});
  const auto scene = room.finish();
  const auto caster = raycast::make_ray_caster("brute", scene);
  const auto method = make_form_factor_method("gauss-lambert", {scene, room.patches, *caster});
  const auto n = static_cast<Index>(room.patches.size());
  const auto whole = form_factors(scene, room.patches, 1e-3);
  core::LocalRun run(1, 1);
  for (Index block : {7, 20}) {
    test::MatrixSink sink(room.patches.size());
    for (Index row = 0; row < n; row += block)
      for (Index column = row; column < n; column += block)
        method->exchange({room.patches, row, std::min(block, n - row)},
                         {room.patches, column, std::min(block, n - column)}, sink, run.get());
    EXPECT_EQ((sink.K - whole.K).cwiseAbs().maxCoeff(), 0.0);
    EXPECT_EQ((sink.error - whole.error).cwiseAbs().maxCoeff(), 0.0);
  }
}

// Every pair that a shaft calls clear is clear to a thousand rays.
TEST(Occlusion, what_a_shaft_proves_clear_no_ray_finds_blocked) {
  Room room = plates_with_screen(6, {.3, .1, .4});
  const auto scene = room.finish();
  const auto caster = raycast::make_ray_caster("brute", scene);
  const ElementShapes shapes(room.patches);
  const Blockers blockers(scene, shapes.origin(), shapes.plane_tolerance());
  const VisibilitySampler sampler(room.patches, *caster, 1024, 9);
  VisibilitySampler::Workspace workspace;
  int clear = 0, needless = 0;
  for (Index i = 0; i < 36; ++i)
    for (Index j = 36; j < 72; ++j) {
      const bool proved = !blockers.any(geometry::Shaft(shapes[i].ring(), shapes[j].ring()));
      const double visible = sampler(i, j, Effort::single, workspace).visible;
      EXPECT_TRUE(!proved || visible == 1.0) << i << " " << j;
      clear += proved;
      needless += !proved && visible == 1.0;
    }
  EXPECT_GT(clear, 300);
  EXPECT_LT(needless, 100) << "shafts are wider than they need to be";
}

TEST(Occlusion, clusters_hold_every_element_once_and_few_each) {
  Room room;
  room.box({0, 0, 0}, {1, 2, 3}, 9);
  const ElementShapes shapes(room.patches);
  std::vector<int> seen(room.patches.size());
  for (const ElementCluster& cluster : clusters_of(room.patches, shapes)) {
    EXPECT_LE(cluster.elements.size(), 32u);
    EXPECT_TRUE(cluster.rectangle.has_value());
    for (const Index e : cluster.elements) ++seen[static_cast<std::size_t>(e)];
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<Index>(seen.size()));
}

TEST(Occlusion, agreeing_rays_are_not_certainty) {
  const std::vector<double> equal(16, 2.5);
  const std::vector<std::uint8_t> clear(16, 0);
  const SampledVisibility v = estimated_visibility(equal, clear);
  EXPECT_EQ(v.visible, 1.0);
  EXPECT_NEAR(v.standard_error, 1.0 / 18, 0.003);
}

}  // namespace
}  // namespace interflect::fem
