#include <gtest/gtest.h>

#include <cmath>

#include "core/hemisphere.h"
#include "fem/form_factor/hidden_exchange.h"
#include "fem/form_factor/point_to_polygon.h"
#include "fem/quadrature.h"
#include "geometry/convex_blocker.h"
#include "tests/fem/direct_light.h"
#include "tests/fem/rooms.h"
#include "tests/support/shapes.h"

namespace interflect::fem {
namespace {

using geometry::ConvexBlocker;
using geometry::Ring;
using test::direct_light;
using test::DirectLight;
using test::Room;

Ring square(double half, double z, double x = 0, double y = 0) {
  return {
      {x - half, y - half, z}, {x - half, y + half, z}, {x + half, y + half, z}, {x + half, y - half, z}};  // fronts -z
}
ElementShape shape(const Ring& ring) { return shape_of(ring, geometry::plane_of(ring)); }

/// F from the point of an upward floor to the seen part of a ring.
double seen_factor(const Vec3& x, const Ring& ring, const std::vector<ConvexBlocker>& blockers,
                   double rounding = 1e-12) {
  std::vector<const ConvexBlocker*> list;
  for (const ConvexBlocker& blocker : blockers) list.push_back(&blocker);
  const ElementShape inner = shape(ring);
  return point_to_polygon(x, Vec3::UnitZ(), ring) -
         HiddenExchange(rounding).hidden_factor(x, Vec3::UnitZ(), inner, list);
}

TEST(Analytic, point_factors_past_a_blocker_are_exact_at_any_scale) {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const DirectLight& point : direct_light) {
      Ring source = square(.5, 2), blocker = square(.5, 1);
      for (Ring* ring : {&source, &blocker})
        for (Vec3& x : *ring) x *= scale;
      EXPECT_NEAR(seen_factor(scale * point.x, source, {}), point.open, 6e-13);
      EXPECT_NEAR(seen_factor(scale * point.x, source, {ConvexBlocker::polygon(blocker)}, 1e-12 * scale), point.blocked,
                  6e-13);
    }
}

// The same blocker as overlapping parts, at other heights where their shadows stay within its own: the union counts,
// not the sum.
TEST(Analytic, point_factors_past_overlapping_blockers_are_those_past_their_union) {
  for (const DirectLight& point : direct_light) {
    const std::vector parts{ConvexBlocker::polygon(Ring{{-.5, -.5, 1}, {-.5, .5, 1}, {.2, .5, 1}, {.2, -.5, 1}}),
                            ConvexBlocker::polygon(Ring{{-.1, -.5, 1}, {-.1, .5, 1}, {.5, .5, 1}, {.5, -.5, 1}}),
                            ConvexBlocker::polygon(Ring{{-.5, -.5, 1}, {-.5, .5, 1}, {.5, -.5, 1}}),
                            ConvexBlocker::polygon(square(.5, 1))};
    EXPECT_NEAR(seen_factor(point.x, square(.5, 2), parts), point.blocked, 6e-13);
    // The blocker's image halfway to the point: in its very shadow.
    Ring image;
    for (const Vec3& corner : square(.5, 1)) image.push_back(0.5 * (corner + point.x));
    EXPECT_NEAR(
        seen_factor(point.x, square(.5, 2), {ConvexBlocker::polygon(image), ConvexBlocker::polygon(square(.5, 1))}),
        point.blocked, 6e-13);
  }
}

Room plates_with_screen(const Vec3& screen_corner) {
  Room room;
  room.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);
  room.wall({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, 1);
  room.screen(screen_corner, {.5, 0, 0}, {0, .5, 0});
  return room;
}

struct Entries {
  Eigen::MatrixXd K, error;
  PairCounts pairs;
};
Entries analytic(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches, double tolerance) {
  const auto caster = raycast::make_ray_caster("brute", scene);
  const auto method = make_form_factor_method("analytic", {scene, patches, *caster, 1, tolerance, 16});
  test::MatrixSink sink(patches.size());
  core::LocalRun run(1, 1);
  const ElementBlock all{patches, 0, static_cast<Index>(patches.size())};
  const PairCounts pairs = method->exchange(all, all, sink, run.get());
  return {sink.K, sink.error, pairs};
}

// docs/truths.md 2.11, V6 and V7.
TEST(Analytic, form_factors_past_a_screen_are_the_exact_ones_to_the_tolerance) {
  for (const double tolerance : {1e-3, 1e-6, 1e-9})
    for (const auto& [corner, exact] :
         {std::pair(Vec3(0, 0, .5), 0.149868671774), std::pair(Vec3(.25, .25, .5), 0.099506294599)}) {
      Room room = plates_with_screen(corner);
      const auto scene = room.finish();
      const Entries F = analytic(scene, room.patches, tolerance);
      EXPECT_EQ(F.pairs.subtracted, 1u);
      EXPECT_NEAR(F.K(0, 1), exact, tolerance * 0.2 + 1e-12) << tolerance;
      EXPECT_NEAR(F.K(0, 1), exact, F.error(0, 1) + 1e-12) << tolerance;
    }
}

// Coarse tolerances leave pairs to its rays, fine ones hand them over.
TEST(Hybrid, samples_what_may_be_noisy_and_subtracts_the_rest) {
  for (const auto& [corner, exact] :
       {std::pair(Vec3(0, 0, .5), 0.149868671774), std::pair(Vec3(.25, .25, .5), 0.099506294599)})
    for (const double tolerance : {0.2, 1e-4}) {
      Room room = plates_with_screen(corner);
      const auto scene = room.finish();
      const auto caster = raycast::make_ray_caster("brute", scene);
      const auto method = make_form_factor_method("hybrid", {scene, room.patches, *caster, 1, tolerance, 16});
      test::MatrixSink sink(2);
      core::LocalRun run(1, 1);
      const ElementBlock all{room.patches, 0, 2};
      const PairCounts counts = method->exchange(all, all, sink, run.get());
      EXPECT_EQ(counts.sampled, tolerance > 0.1 ? 1u : 0u);
      EXPECT_EQ(counts.subtracted, tolerance > 0.1 ? 0u : 1u);
      EXPECT_NEAR(sink.K(0, 1), exact, 4 * sink.error(0, 1));
      EXPECT_LT(sink.error(0, 1), 2 * tolerance * 0.2);  // of the unoccluded part, and of what is hidden
    }
}

double hybrid(Room& room, const scene::Scene& scene, double tolerance, std::uint64_t seed,
              double* standard_error = nullptr) {
  const auto caster = raycast::make_ray_caster("brute", scene);
  const auto method = make_form_factor_method("hybrid", {scene, room.patches, *caster, seed, tolerance, 16});
  test::MatrixSink sink(2);
  core::LocalRun run(1, 1);
  const ElementBlock all{room.patches, 0, 2};
  method->exchange(all, all, sink, run.get());
  if (standard_error) *standard_error = sink.error(0, 1);
  return sink.K(0, 1);
}

// Where one view point of the element has 0.1901 and 0.2395 [Baum, Rushmeier, Winget 1989].
TEST(Hybrid, of_squares_that_touch_or_face_each_other_converges_to_the_right_values) {
  Room corner, facing;
  corner.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);
  corner.wall({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1);
  facing.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);
  facing.wall({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, 1);
  const auto corner_scene = corner.finish(), facing_scene = facing.finish();
  for (const double tolerance : {1e-1, 1e-3, 1e-6, 1e-10}) {
    EXPECT_NEAR(hybrid(corner, corner_scene, tolerance, 1), 0.20004377607540315, 0.2 * tolerance);
    EXPECT_NEAR(hybrid(facing, facing_scene, tolerance, 1), 0.19982489569838738, 0.2 * tolerance);
  }
}

// Past screens, by 400 seeds: the mean is right within 4 of its standard errors (alpha 1e-4), and single values are not
// further off than they say.
TEST(Hybrid, past_a_screen_is_right_in_the_mean_and_within_its_standard_errors) {
  constexpr int seeds = 400;
  for (const auto& [corner, exact] :
       {std::pair(Vec3(0, 0, .5), 0.149868671774), std::pair(Vec3(.25, .25, .5), 0.099506294599)}) {
    Room room = plates_with_screen(corner);
    const auto scene = room.finish();
    double sum = 0, squares = 0, z_squares = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      double said = 0;
      const double off = hybrid(room, scene, 0.2, seed, &said) - exact;
      sum += off;
      squares += off * off;
      z_squares += off * off / (said * said);
    }
    EXPECT_LT(std::abs(sum), 4 * std::sqrt(squares));
    EXPECT_LT(z_squares / seeds, 1 + 4 * std::sqrt(2.0 / seeds));
    EXPECT_GT(z_squares / seeds, 0.1) << "noise is far below what is said";
  }
}

// docs/truths.md 2.11, V5, with the inner cube turned: convex in convex, F(in, out) = 1, and rows of the outer sum
// to 1.
TEST(Analytic, rows_of_a_closed_room_with_a_body_sum_to_one_to_the_tolerance) {
  for (const double tolerance : {1e-3, 1e-5}) {
    Room room;
    room.box({0, 0, 0}, {5, 4, 3}, 3);
    room.box({1, 1, .2}, {1, .8, 1.2}, 2, false);
    room.box({3, 2.2, .5}, {1, .8, 1.1}, 2, false);
    const auto scene = room.finish();
    const Entries F = analytic(scene, room.patches, tolerance);
    for (Index i = 0; i < F.K.rows(); ++i) {
      const double area = room.patches[static_cast<std::size_t>(i)].area;
      EXPECT_NEAR(F.K.row(i).sum() / area, 1, tolerance) << i;
      EXPECT_LE(F.error.row(i).sum() / area, 2 * tolerance) << i;  // the unoccluded part and what is hidden of it
    }
  }
}

// Lengths times a power of two: the same digits, tolerances, cuts and all.
TEST(Analytic, form_factors_are_the_same_bits_at_scales_of_powers_of_two) {
  const auto K_at = [](double scale) {
    Room room;
    room.box({0, 0, 0}, scale * Vec3(5, 4, 3), 2);
    room.box(scale * Vec3(1, 1, .25), scale * Vec3(1, .75, 1.25), 1, false);
    room.box(scale * Vec3(3, 2.25, .5), scale * Vec3(1, .75, 1.125), 1, false);
    const auto scene = room.finish();
    return Eigen::MatrixXd(analytic(scene, room.patches, 1e-4).K / (scale * scale));
  };
  const Eigen::MatrixXd K = K_at(1);
  for (const double scale : {0x1p-20, 0x1p20}) EXPECT_EQ(K_at(scale), K);
}

// A body of 1 m x 0.8 m on the floor: what of the floor it covers sees nothing, and nothing sees that.
TEST(Analytic, what_a_body_stands_on_is_dark) {
  Room room;
  room.box({0, 0, 0}, {5, 4, 3}, 3);
  room.box({1, 1, 0}, {1, .8, 1.2}, 2, false);
  const auto scene = room.finish();
  const Entries F = analytic(scene, room.patches, 1e-5);
  double floor = 0, below = 0;
  for (Index i = 0; i < F.K.rows(); ++i) {
    const scene::SurfacePatch& patch = room.patches[static_cast<std::size_t>(i)];
    const double sum = F.K.row(i).sum();
    if (patch.normal().z() > 0.5 && patch.corner[0].z() == 0)
      floor += sum;
    else if (patch.normal().z() < -0.5 && patch.corner[0].z() == 0)
      below += sum;
    else
      EXPECT_NEAR(sum / patch.area, 1, 1e-5) << i;
  }
  EXPECT_NEAR(floor, 5 * 4 - 1 * .8, 1e-5 * 20);
  EXPECT_EQ(below, 0);
}

// A table's leg beside a triangle of the floor, whose corner touches the leg's edge, before a wall: the lines along the
// floor from the wall's corner past the leg's edge end in that edge's end. Against rays, within four of their standard
// errors.
TEST(Analytic, what_stands_on_the_floor_hides_along_the_floor) {
  Room room;
  room.triangle({4.48, 1.35, 0}, {4.5, 1.35, 0}, {4.49, 1.38, 0});
  room.triangle({5, 1.5, .45}, {5, 1.5, 0}, {5, 1, 0});
  room.screen({4.46, 1.35, 0}, {.04, 0, 0}, {0, 0, .72});
  room.screen({4.5, .65, 0}, {0, .7, 0}, {0, 0, .72});
  const auto scene = room.finish();
  const Entries F = analytic(scene, room.patches, 1e-6);
  const auto caster = raycast::make_ray_caster("brute", scene);
  const auto by_rays = make_form_factor_method("gauss-lambert", {scene, room.patches, *caster, 1, 1e-6, 65536});
  test::MatrixSink rays(2);
  core::LocalRun run(1, 1);
  const ElementBlock all{room.patches, 0, 2};
  by_rays->exchange(all, all, rays, run.get());
  EXPECT_NEAR(F.K(0, 1), rays.K(0, 1), 4 * rays.error(0, 1));
  EXPECT_LT(rays.error(0, 1), 1e-3 * F.K(0, 1));
}

/// How many of n cosine-distributed rays from a triangle arrive at the fronts of each of the others.
std::vector<int> arrivals(const scene::Scene& scene, const scene::SurfacePatch& from, const raycast::RayCaster& rays,
                          int n, std::uint64_t seed) {
  std::vector<int> hits(scene.surfaces.size(), 0);
  const Vec3 normal = from.normal();
  for (int k = 0; k < n; ++k) {
    core::RandomNumbers u(seed, 1, static_cast<std::uint64_t>(k));
    const double a = u.next(), b = u.next(), c = u.next(), d = u.next();
    const Vec3 x = core::triangle_point(from.corner[0], from.corner[1], from.corner[2], a, b);
    const auto hit = rays.closest({x, core::frame_around(normal).to_world(core::cosine_hemisphere(c, d)), normal});
    if (hit && hit->side == scene::Side::front) ++hits[hit->surface.value];
  }
  return hits;
}

/// Ten triangles anywhere, crossing each other.
Room ten_triangles(std::uint32_t stream) {
  core::RandomNumbers u(77, stream, 0);
  const auto vector = [&] {
    const double x = u.next(), y = u.next(), z = u.next();
    return Vec3(2 * x - 1, 2 * y - 1, 2 * z - 1);
  };
  Room room;
  for (int k = 0; k < 10; ++k) {
    const Vec3 centre = vector();
    room.triangle(centre + 0.8 * vector(), centre + 0.8 * vector(), centre + 0.8 * vector());
  }
  return room;
}

// All that shaft, shadows and clipping know, against rays that know none of it.  F_ij A_i is compared from both ends:
// about 1 000 counts, binomial with n F expected; those with 10 expected or more are nearly normal.
TEST(Analytic, random_scenes_of_ten_crossing_triangles_agree_with_ten_million_rays) {
  constexpr int scenes = 25, rays_each = 40'000;
  double squares = 0, largest = 0, n = 0;
  for (std::uint32_t s = 0; s < scenes; ++s) {
    Room room = ten_triangles(s);
    const auto scene = room.finish();
    const auto caster = raycast::make_ray_caster("brute", scene);
    const Entries F = analytic(scene, room.patches, 1e-4);
    for (Index i = 0; i < 10; ++i) {
      const scene::SurfacePatch& from = room.patches[static_cast<std::size_t>(i)];
      const std::vector<int> hits =
          arrivals(scene, from, *caster, rays_each, static_cast<std::uint64_t>(10 * s) + static_cast<std::uint64_t>(i));
      for (Index j = 0; j < 10; ++j) {
        const double expected = rays_each * F.K(i, j) / from.area, count = hits[static_cast<std::size_t>(j)];
        if (expected < 10) {
          EXPECT_LT(count, 40) << s << ": " << i << " to " << j << ", " << expected;  // probability below 1e-10 each
          continue;
        }
        const double z = (count - expected) / std::sqrt(expected * (1 - expected / rays_each));
        squares += z * z;
        largest = std::max(largest, std::abs(z));
        ++n;
      }
    }
  }
  EXPECT_GT(n, 600);
  EXPECT_LT(largest, 5);  // alpha 1e-3 for 1 000, with room for skewness
  EXPECT_NEAR(squares / n, 1, 4 * std::sqrt(2 / n));
}

}  // namespace
}  // namespace interflect::fem
