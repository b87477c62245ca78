#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "fem/form_factor/point_to_polygon.h"
#include "fem/form_factor/seen_element.h"
#include "fem/form_factor/uniform_map.h"
#include "fem/two_views.h"
#include "tests/fem/monte_carlo.h"

namespace interflect::fem {
namespace {

using test::Assembled;
using test::monte_carlo_methods;
using test::Room;
using test::Sampled;

/// Limit of one comparison in standard errors.  Normal: beyond 5 with probability 6e-7.  The errors of area-to-area are
/// Student's with 15 degrees of freedom over their own deviation: beyond 5 of that with probability 8e-5.  A test's
/// family alpha is the number of its comparisons times these.
constexpr double limit = 5;

std::uint64_t samples_for(const std::string& method, double share = 1) {
  const double whole = method == "area-to-area" ? 4096 : method == "hemisphere-rays" ? 40'000 : 400'000;
  return static_cast<std::uint64_t>(share * whole);
}

struct Known {
  const char* name;
  Room (*room)(double scale);
  double truth;
};
const std::vector<Known> closed_forms{
    {"face to face", test::facing_squares, test::facing_truth},
    {"common edge", test::squares_with_common_edge, test::edge_truth},
    {"V6", [](double scale) { return test::screened_squares(0, scale); }, test::corner_screen_truth},
    {"V7", [](double scale) { return test::screened_squares(.25, scale); }, test::centre_screen_truth}};

// 36 comparisons, a third of them Student's: alpha 1e-3.
TEST(MonteCarloFormFactors, are_the_closed_forms_within_their_standard_errors_at_any_scale) {
  for (const Known& known : closed_forms)
    for (const double scale : {1e-6, 1.0, 1e6}) {
      const Sampled sampled(known.room(scale));
      for (const std::string& method : monte_carlo_methods) {
        const Assembled found = sampled.by(method, samples_for(method));
        const double F = found.K(0, 1) / (scale * scale), error = found.error(0, 1) / (scale * scale);
        EXPECT_LT(std::abs(F - known.truth), limit * error) << method << ' ' << known.name << ' ' << scale;
        EXPECT_LT(error, 0.02 * known.truth) << method << ' ' << known.name;
        EXPECT_GT(error, 0) << method << ' ' << known.name;
      }
    }
}

// docs/truths.md 2.11, V5, the inner cube off the centre.  On a line that crosses the inner cube two pairs are of one
// kind, and so the error of their sum is up to sqrt(2) times that of independent ones.  9 comparisons: alpha 4e-4.
TEST(MonteCarloFormFactors, of_a_cube_in_a_cube_are_eight_ninths_one_ninth_and_one) {
  Room room;
  room.box({0, 0, 0}, {3, 3, 3}, 2);
  room.box({.4, 1.2, 1.7}, {1, 1, 1}, 1, false);
  const Sampled sampled(room);
  for (const std::string& method : monte_carlo_methods) {
    const Assembled found = sampled.by(method, samples_for(method, 0.5));
    double sum[2][2] = {}, squares[2][2] = {};
    for (Index i = 0; i < 30; ++i)
      for (Index j = 0; j < 30; ++j)
        sum[i >= 24][j >= 24] += found.K(i, j), squares[i >= 24][j >= 24] += std::pow(found.error(i, j), 2);
    const double outer = 54, inner = 6;
    const auto near = [&](int a, int b, double area, double truth, double pairs_twice) {
      EXPECT_LT(std::abs(sum[a][b] / area - truth), limit * std::sqrt(2 * pairs_twice * squares[a][b]) / area)
          << method << a << b;
    };
    near(0, 0, outer, 8.0 / 9, 2);  // both triangles: each error twice
    near(0, 1, outer, 1.0 / 9, 1);
    near(1, 0, inner, 1, 1);
  }
}

// Each entry against `analytic` at tolerance 1e-6.  36 elements, 630 pairs.  Where at least 30 hits are expected
// standardised errors are normal: none beyond 5 (7 of Student's), family alpha 2e-3, and the mean of their squares is 1
// within 4.5 sqrt(2 / n); alpha 1e-5.
TEST(MonteCarloFormFactors, are_those_of_analytic_in_a_room_with_boxes_and_rows_sum_to_one) {
  const Sampled sampled(test::room_with_boxes(2));
  const Assembled exact = sampled.by("analytic", 0, 1, 1e-6);
  for (const std::string& method : monte_carlo_methods) {
    const Assembled found = sampled.by(method, samples_for(method, 0.5));
    const Index n = exact.K.rows();
    double squares = 0;
    int compared = 0;
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < i; ++j) {
        const double truth = exact.K(i, j), difference = found.K(i, j) - truth, error = found.error(i, j);
        ASSERT_TRUE(std::isfinite(found.K(i, j)) && std::isfinite(error));
        EXPECT_LE(found.K(i, j), std::min(sampled.area(i), sampled.area(j)));
        EXPECT_TRUE(truth <= 1e-9 || error > 0) << method << i << ' ' << j;
        if (!(truth > 30 * error * error / truth)) continue;  // (truth / error)² is the number of hits
        ++compared;
        squares += std::pow(difference / error, 2);
        EXPECT_LT(std::abs(difference), (method == "area-to-area" ? 7 : limit) * error) << method << i << ' ' << j;
      }
      EXPECT_NEAR(found.K.row(i).sum(), sampled.area(i), limit * found.error.row(i).norm() + 1e-9) << method << i;
    }
    EXPECT_GT(compared, 150) << method;
    // area-to-area: the net of points is even, and where its rays agree its errors are cautious.
    EXPECT_LT(squares / compared, 1 + 4.5 * std::sqrt(2.0 / compared)) << method;
    EXPECT_GT(squares / compared, method == "area-to-area" ? 0 : 1 - 4.5 * std::sqrt(2.0 / compared)) << method;
  }
}

// V7 over 800 seeds, about 100 hits each.  Mean and mean square of z = (K - truth) / s, two-sided at 4.5 standard
// deviations each: alpha 7e-6 a number, 4e-5 in all.  The fourth moment of z is 3, or 3.55 of Student's with 15 degrees
// of freedom; points that are evenly spread take up to 4 % off the variance of hemisphere rays, and two hits added 2 %.
TEST(MonteCarloFormFactors, standardised_errors_are_standard_normal_in_mean_and_variance) {
  constexpr int seeds = 800;
  const Sampled sampled(test::screened_squares(.25));
  for (const auto& [method, samples] :
       {std::pair("area-to-area", 512u), std::pair("hemisphere-rays", 1024u), std::pair("global-lines", 5000u)}) {
    double sum = 0, squares = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      const Assembled found = sampled.by(method, samples, static_cast<std::uint64_t>(seed), 1e-3, 1);
      const double z = (found.K(0, 1) - test::centre_screen_truth) / found.error(0, 1);
      sum += z;
      squares += z * z;
    }
    // s and K rise and fall together, which moves the mean of z by about -1 / (2 sqrt(hits)).
    EXPECT_NEAR(sum / seeds, 0, 4.5 / std::sqrt(seeds) + 0.06) << method;
    EXPECT_NEAR(squares / seeds, 1, 4.5 * std::sqrt(2.6 / seeds) + 0.06) << method;
  }
}

// Small entries: about one hit a view.  Weighted by their own errors the two views would be 11 % too low together.
// The mean over 4 000 seeds, two-sided at 4.5 of its standard errors: alpha 7e-6.
TEST(MonteCarloFormFactors, of_hemisphere_rays_are_unbiased_where_hits_are_few) {
  constexpr int seeds = 4000;
  const Sampled sampled(test::facing_squares());
  double sum = 0, squares = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const double K = sampled.by("hemisphere-rays", 5, static_cast<std::uint64_t>(seed), 1e-3, 1).K(0, 1);
    sum += K;
    squares += K * K;
  }
  const double mean = sum / seeds, deviation = std::sqrt((squares / seeds - mean * mean) / seeds);
  EXPECT_NEAR(mean, test::facing_truth, 4.5 * deviation);
  EXPECT_LT(deviation, 0.005);
}

TEST(MonteCarloFormFactors, are_the_same_for_any_number_of_threads) {
  const Sampled sampled(test::room_with_boxes(1));
  for (const std::string& method : monte_carlo_methods) {
    const Assembled once = sampled.by(method, samples_for(method, 0.05), 3, 1e-3, 1);
    for (const unsigned threads : {2u, 3u, 8u}) {
      const Assembled again = sampled.by(method, samples_for(method, 0.05), 3, 1e-3, threads);
      EXPECT_EQ(once.K, again.K) << method << threads;
      EXPECT_EQ(once.error, again.error) << method << threads;
      EXPECT_EQ(once.pairs.rays, again.pairs.rays) << method << threads;
    }
    EXPECT_NE(once.K, sampled.by(method, samples_for(method, 0.05), 4, 1e-3, 1).K) << method;
  }
}

TEST(MonteCarloFormFactors, are_the_same_in_any_blocks) {
  const Sampled sampled(test::room_with_boxes(1));
  const auto& patches = sampled.patches();
  const auto n = static_cast<Index>(patches.size());
  core::LocalRun run(1, 1);
  for (const std::string name : {"area-to-area", "hemisphere-rays"}) {
    const auto method = make_form_factor_method(name, sampled.context(samples_for(name, 0.05)));
    const bool by_row = method->granularity() == FormFactorMethod::Granularity::row;
    const auto blocks_of = [&](Index rows, Index columns) {
      test::MatrixSink sink(patches.size());
      for (Index i = 0; i < n; i += rows)
        for (Index j = 0; j < n; j += columns)
          method->exchange({patches, i, std::min(rows, n - i)}, {patches, j, std::min(columns, n - j)}, sink,
                           run.get());
      return sink.K;
    };
    const Eigen::MatrixXd whole = blocks_of(n, n);
    EXPECT_EQ(whole, blocks_of(1, n)) << name;
    EXPECT_EQ(whole, blocks_of(5, n)) << name;
    EXPECT_EQ(whole, blocks_of(5, by_row ? n : 7)) << name;
  }
}

// A patch of a thousandth of the other's area, against `analytic`: K is one number, seen from both.
TEST(MonteCarloFormFactors, of_areas_a_thousand_times_apart_agree_with_analytic) {
  Room room;
  room.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);
  const double side = std::sqrt(1e-3);
  room.wall({.4, .5, .6}, {0, side, 0}, {side, 0, 0}, 1);
  const Sampled sampled(room);
  const double truth = sampled.by("analytic", 0, 1, 1e-9).K(0, 1);
  for (const std::string& method : monte_carlo_methods) {
    const Assembled found = sampled.by(method, samples_for(method, method == "global-lines" ? 10 : 1));
    EXPECT_NEAR(found.K(0, 1), truth, limit * found.error(0, 1)) << method;
    EXPECT_LT(found.error(0, 1), 0.1 * truth) << method;
  }
}

// Quads without parallel sides, triangles, and a pair that reaches through each other's planes.  3 methods x 10 pairs:
// alpha 1e-3.
TEST(MonteCarloFormFactors, of_odd_shapes_agree_with_analytic) {
  Room room;
  room.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  room.triangle({0, 0, 1}, {0, 2, 1}, {2, 0, 1});
  room.triangle({.2, .1, .8}, {.3, 1.2, 1.1}, {1.1, .3, 1.4});
  room.wall({1.5, 0, -.2}, {0, 0, 1}, {0, 1, 0}, 1);
  const geometry::Ring trapezoid{{-.5, 0, .1}, {-.5, 1.4, .1}, {-.4, .9, .8}, {-.4, .3, .8}};
  room.patches.push_back(
      scene::make_patch(room.wall({-9, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1), scene::Side::front, trapezoid));
  room.patches.erase(room.patches.end() - 2);
  const Sampled sampled(room);
  const Assembled exact = sampled.by("analytic", 0, 1, 1e-7);
  const Assembled found = sampled.by("area-to-area", samples_for("area-to-area"));
  for (Index i = 0; i < 4; ++i)
    for (Index j = 0; j < i; ++j) EXPECT_NEAR(found.K(i, j), exact.K(i, j), limit * found.error(i, j) + 1e-9) << i << j;
  for (const std::string method : {"hemisphere-rays", "global-lines"}) {
    const Assembled counted = sampled.by(method, samples_for(method));
    for (Index i = 0; i < 4; ++i)
      for (Index j = 0; j < i; ++j)
        EXPECT_NEAR(counted.K(i, j), exact.K(i, j), limit * counted.error(i, j) + 1e-9) << method << i << j;
  }
}

TEST(MonteCarloFormFactors, that_found_nothing_keep_an_error_and_proved_dark_pairs_have_none) {
  Room room = test::facing_squares();
  room.wall({0, 0, -1}, {0, 1, 0}, {1, 0, 0}, 1);  // behind the first, and facing away from it
  room.screen({-.5, -.5, .5}, {2, 0, 0}, {0, 2, 0});
  const Sampled sampled(room);
  for (const std::string& method : monte_carlo_methods) {
    const Assembled found = sampled.by(method, samples_for(method, 0.1));
    EXPECT_EQ(found.K(0, 1), 0) << method;
    EXPECT_GT(found.error(0, 1), 0) << method;
    EXPECT_LT(found.error(0, 1), 0.01) << method;
    EXPECT_EQ(found.K(0, 2), 0) << method;
    EXPECT_EQ(found.error(0, 2), 0) << method;
  }
}

// A patch 1 mm before a wall: F = 1 - 1e-5, so that counts go above half of the time.
TEST(MonteCarloFormFactors, above_one_are_pulled_back_and_counted) {
  Room room;
  room.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);
  room.wall({.45, .45, .001}, {0, .1, 0}, {.1, 0, 0}, 1);
  const Sampled sampled(room);
  std::uint64_t clamped = 0;
  for (const std::string& method : monte_carlo_methods)
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const Assembled found = sampled.by(method, samples_for(method, 0.1), seed);
      EXPECT_LE(found.K(0, 1), sampled.area(1)) << method;
      EXPECT_GT(found.K(0, 1), 0.005) << method;
      clamped += found.pairs.clamped;
    }
  EXPECT_GT(clamped, 10u);
}

// With samples at 0: each takes what its documentation says.
TEST(MonteCarloFormFactors, take_as_many_samples_as_the_tolerance_asks_for) {
  const Sampled sampled(test::screened_squares(.25));
  for (const double tolerance : {0.05, 0.02}) {
    const Assembled pairs = sampled.by("area-to-area", 0, 1, tolerance);
    EXPECT_LE(pairs.error(0, 1), tolerance * test::facing_truth * 1.05);
    EXPECT_LT(pairs.pairs.rays, 16384u);
    const Assembled rows = sampled.by("hemisphere-rays", 0, 1, tolerance);
    EXPECT_EQ(rows.pairs.rays % 1024, 0u);
    EXPECT_LE(rows.error(0, 1), 1.05 * tolerance);
    EXPECT_LT(rows.pairs.rays, 2 * (1024 + 0.1 / (tolerance * tolerance)));
    const Assembled lines = sampled.by("global-lines", 0, 1, tolerance);
    EXPECT_EQ(lines.pairs.rays, static_cast<std::uint64_t>(std::ceil(2 * pi * 0.75 / (tolerance * tolerance))));
  }
  const Assembled most = sampled.by("area-to-area", 0, 1, 1e-9);
  EXPECT_LE(most.pairs.rays, 16384u);
  EXPECT_GT(most.pairs.rays, 8000u);
}

// A furnace: every surface of a closed room emits 1 and reflects half, so that B = 2 everywhere, which rows that sum to
// one keep: an error dF of a row's sum is one of 2 dF in B at most.  Rows at 10^4 samples are off by less than 5 / 100
// with the closed forms' alpha.
TEST(MonteCarloFormFactors, heat_a_furnace_through_the_whole_method) {
  Room room;
  room.box({0, 0, 0}, {1, 1, 1}, 1, true, 0.5, 1.0);
  const scene::Scene scene = room.finish();
  for (const std::string& method : monte_carlo_methods) {
    RadiositySettings settings;
    settings.element_size = 0.4;
    settings.quadrature_tolerance = 0.01;
    settings.form_factors = method;
    core::LocalRun run(1, 2);
    EXPECT_GT(forecast(scene, settings, run.get()).seconds, 0) << method;
    const RadiositySolution solution = solve_radiosity(scene, settings, run.get());
    for (const Spectrum& B : solution.radiosity) EXPECT_NEAR(B[0], 2, 0.1) << method;
  }
}

TEST(MonteCarloFormFactors, stop_when_asked_to) {
  const Sampled sampled(test::room_with_boxes(1));
  for (const std::string& name : monte_carlo_methods) {
    const auto method = make_form_factor_method(name, sampled.context(0));
    test::MatrixSink sink(sampled.patches().size());
    core::LocalRun run(1, 2);
    std::stop_source stop;
    run.get().stop = stop.get_token();
    stop.request_stop();
    EXPECT_THROW(assemble(*method, sampled.patches(), sink, run.get()), core::Interrupted) << name;
  }
}

// The centroid of evenly spread points is that of the area: 256 x 256 of them, midpoint rule.
TEST(UniformMap, is_area_preserving_on_triangles_and_on_quads_without_parallel_sides) {
  for (const geometry::Ring& ring :
       {geometry::Ring{{0, 0, 0}, {3, 0, 0}, {0, 1, 1}}, geometry::Ring{{0, 0, 0}, {4, 0, 0}, {1.5, 1, 0}, {1, 1, 0}},
        geometry::Ring{{0, 0, 0}, {1, -.2, 0}, {3, 3, 0}, {-.5, .6, 0}}}) {
    const UniformMap map(ring);
    constexpr int n = 256;
    Vec3 mean = Vec3::Zero();
    double second = 0;
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b) {
        const Vec3 x = map((a + .5) / n, (b + .5) / n);
        mean += x / (n * n);
        second += x.squaredNorm() / (n * n);
      }
    const auto patch = scene::make_patch(scene::SurfaceId{0}, scene::Side::front, ring);
    EXPECT_LT((mean - patch.centroid()).norm(), 1e-4);
    double moment = 0;  // int |x|² over a triangle abc: area / 12 (|a|² + |b|² + |c|² + |a + b + c|²)
    for (std::size_t k = 2; k < ring.size(); ++k) {
      const Vec3 &a = ring[0], &b = ring[k - 1], &c = ring[k];
      moment += 0.5 * (b - a).cross(c - a).norm() / 12 *
                (a.squaredNorm() + b.squaredNorm() + c.squaredNorm() + (a + b + c).squaredNorm());
    }
    EXPECT_NEAR(second, moment / patch.area, 1e-4 * second);
  }
}

// Omega times the mean of cos / pi is Lambert's factor.
TEST(SeenElement, directions_are_uniform_in_solid_angle) {
  for (const geometry::Ring& ring : {geometry::Ring{{-1, -1, 1}, {-1, 2, 1}, {1.5, -1, 1.2}},
                                     geometry::Ring{{1, -1, .1}, {1, -1, 2}, {1, 1, 2}, {1, 1, .1}},
                                     geometry::Ring{{-9, -9, .01}, {-9, 9, .01}, {9, 9, .01}, {9, -9, .01}}}) {
    const Vec3 eye(.1, .2, 0);
    const SeenElement seen(eye, ring);
    ASSERT_GT(seen.solid_angle(), 0);
    const geometry::Plane plane = geometry::plane_of(ring);
    constexpr int n = 512;
    double sum = 0;
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b) {
        const Vec3 direction = seen.direction((a + .5) / n, (b + .5) / n);
        EXPECT_NEAR(direction.norm(), 1, 1e-9);
        EXPECT_LT(direction.dot(plane.normal), 0);
        sum += direction.z();
      }
    EXPECT_NEAR(seen.solid_angle() * sum / (n * n) / pi, point_to_polygon(eye, Vec3::UnitZ(), ring), 2e-4);
  }
  EXPECT_EQ(SeenElement({0, 0, 2}, geometry::Ring{{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}}).solid_angle(),
            0);  // from behind
}

TEST(TwoViews, are_joined_by_their_rows_weights_where_there_are_any) {
  TwoViews views(2);
  views.add(0, 1, {1, 0.1, 0});
  views.add(1, 0, {2, 0.2, 0});
  EXPECT_NEAR(views.joined(0, 1).K, 1.2, 1e-6);
  views.weigh_row(0, 1);
  EXPECT_NEAR(views.joined(0, 1).K, 1.2, 1e-6);  // one weight alone says nothing
  views.weigh_row(1, 3);
  EXPECT_NEAR(views.joined(0, 1).K, 1.75, 1e-6);
  EXPECT_NEAR(views.joined(1, 0).standard_error, std::hypot(0.25 * 0.1, 0.75 * 0.2), 1e-6);
}

}  // namespace
}  // namespace interflect::fem
