#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fem/form_factor/adaptive_lambert.h"
#include "fem/form_factor/contour.h"
#include "fem/form_factor/pair_integral.h"
#include "fem/form_factor/polygon_pair.h"
#include "fem/form_factor/rectangle_pair.h"
#include "scene/place.h"
#include "tests/fem/random_pairs.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using geometry::Ring;
using test::area_of;
using test::every_nearness;
using test::Nearness;
using test::normal_of;
using test::RandomPairs;
using test::RingPair;

scene::SurfacePatch patch(std::uint32_t surface, const Ring& ring) {
  return scene::make_patch({surface}, scene::Side::front, ring);
}
PairIntegral integrate(const Ring& a, const Ring& b, double tolerance) {
  const std::vector patches{patch(0, a), patch(1, b)};
  return PairIntegrator(patches, tolerance)(0, 1);
}
Ring scaled(Ring ring, double scale, const Vec3& shift = Vec3::Zero()) {
  for (Vec3& p : ring) p = scale * p + shift;
  return ring;
}
Ring turned(Ring ring) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.0, Vec3(3, 1, 2).normalized()).toRotationMatrix();
  for (Vec3& p : ring) p = turn * p;
  return ring;
}

const Ring unit_square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const Ring square_above = {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
const Ring square_beside = {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
const Ring triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
const Ring triangle_above = {{0, 0, 1}, {0, 2, 1}, {2, 0, 1}};
const Ring triangle_aslant = {{.2, .1, .8}, {.3, 1.2, 1.1}, {1.1, .3, 1.4}};
const Ring low = {{.1, .3, 0}, {.6, .3, 0}, {.6, .9, 0}, {.1, .9, 0}};
const Ring high = {{.5, .2, .7}, {.5, .8, .7}, {1.3, .8, .7}, {1.3, .2, .7}};
const Ring floor_ = {{.2, 0, 0}, {1.2, 0, 0}, {1.2, 1, 0}, {.2, 1, 0}};
const Ring wall = {{0, .4, .3}, {0, 2, .3}, {0, 2, 1.5}, {0, .4, 1.5}};

/// K = A F of two rings, as far as it is known: F with its last digit's unit.
struct Known {
  Ring a, b;
  double K, error;
};
// The squares have closed forms. The other values are by an outer Gauss rule over Lambert's formula, and printed to the
// digits given here.
std::vector<Known> known_values() {
  return {{unit_square, square_above, 0.19982489569838738, 1e-15},
          {unit_square, square_beside, 0.20004377607540315, 1e-15},
          {triangle, triangle_above, 0.284312520989 / 2, 5e-13},
          {triangle, triangle_aslant, 0.083671221476 / 2, 5e-13},
          {low, high, 0.03513229219968, 1e-14},
          {floor_, wall, 0.117161328423, 5e-13}};
}

TEST(ClosedFormPairs, have_the_known_values) {
  for (const Known& known : known_values()) {
    const double tolerance = known.error + 1e-15;
    EXPECT_NEAR(polygon_pair(known.a, known.b, 1e-13).value, known.K, tolerance);
    EXPECT_NEAR(double_contour(known.a, known.b).value, known.K, tolerance);
    EXPECT_NEAR(adaptive_lambert(known.a, normal_of(known.a), known.b, 1e-11).value, known.K,
                1e-11 * known.K + tolerance);
    EXPECT_NEAR(integrate(known.a, known.b, 1e-13).value, known.K, tolerance);
    const auto rectangles = rectangle_pair(known.a, known.b);
    EXPECT_EQ(rectangles.has_value(), known.a.size() == 4);
    if (rectangles) {
      EXPECT_NEAR(rectangles->value, known.K, tolerance);
    }
  }
}

// At every scale, turned, to the tolerance asked for.
TEST(ClosedFormPairs, have_the_known_values_at_every_scale_and_turned) {
  for (const Known& known : known_values())
    for (const double scale : {1e-6, 1.0, 1e6}) {
      const Ring a = scaled(turned(known.a), scale), b = scaled(turned(known.b), scale);
      for (const double tolerance : {1e-4, 1e-9, 1e-13}) {
        const PairIntegral found = integrate(a, b, tolerance);
        EXPECT_NEAR(found.value / (scale * scale), known.K, known.error + std::max(tolerance, 1e-12) * known.K)
            << scale;
        EXPECT_LE(found.error, tolerance * found.value);
      }
    }
}

// F_parallel + 4 F_perpendicular = 1 in a cube.
TEST(ClosedFormPairs, of_a_cube_sum_to_one) {
  const double sum =
      rectangle_pair(unit_square, square_above)->value + 4 * rectangle_pair(unit_square, square_beside)->value;
  EXPECT_NEAR(sum, 1.0, 2e-15);
}

/// The faces of the cube [-half, half]^3, seen from inside or outside.
std::vector<Ring> cube(double half, bool inwards) {
  std::vector<Ring> faces;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-half, half}) {
      Vec3 u = Vec3::Zero(), v = Vec3::Zero(), middle = Vec3::Zero();
      u[(axis + 1) % 3] = v[(axis + 2) % 3] = half;
      middle[axis] = side;
      if ((side > 0) == inwards) std::swap(u, v);
      faces.push_back({middle - u - v, middle + u - v, middle + u + v, middle - u + v});
    }
  return faces;
}

// docs/truths.md 2.11, V5: a convex body in a convex one sends all to it, F(in, out) = 1; sides reach through each
// other's planes, and are clipped.
TEST(ClosedFormPairs, from_a_cube_to_the_cube_around_it_sum_to_one) {
  for (const Ring& inner : cube(.5, false)) {
    double sum = 0;
    for (const Ring& outer : cube(1.5, true)) sum += integrate(turned(inner), turned(outer), 1e-13).value;
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

// Below K = min(A) / 20 what is summed cancels.
bool well_posed(const RingPair& pair, double K) { return K > .05 * std::min(area_of(pair.a), area_of(pair.b)); }

TEST(ClosedFormPairs, are_reciprocal) {
  for (const Nearness nearness : every_nearness) {
    RandomPairs random(1);
    for (int k = 0; k < 200; ++k) {
      const RingPair pair = random.pair(nearness);
      const double K = polygon_pair(pair.a, pair.b, 1e-14).value;
      if (!well_posed(pair, K)) continue;
      EXPECT_NEAR(polygon_pair(pair.b, pair.a, 1e-14).value / K, 1.0, 1e-13);
      EXPECT_NEAR(integrate(pair.b, pair.a, 1e-13).value / integrate(pair.a, pair.b, 1e-13).value, 1.0, 1e-13);
    }
  }
}

/// A convex ring cut along the line through random points of two of its edges.
std::pair<Ring, Ring> split(const Ring& ring, RandomPairs& random) {
  const std::size_t n = ring.size(), second = 1 + static_cast<std::size_t>(random.next() * static_cast<double>(n - 1));
  const auto point_after = [&](std::size_t k) -> Vec3 {
    return ring[k] + random.next() * (ring[(k + 1) % n] - ring[k]);
  };
  const Vec3 p = point_after(0), q = point_after(second);
  Ring left{p}, right{q};
  for (std::size_t k = 1; k <= second; ++k) left.push_back(ring[k]);
  for (std::size_t k = second + 1; k <= n; ++k) right.push_back(ring[k % n]);
  left.push_back(q);
  right.push_back(p);
  return {left, right};
}

TEST(ClosedFormPairs, are_additive_under_random_splits_of_both) {
  int compared = 0;
  for (const Nearness nearness : every_nearness) {
    RandomPairs random(2);
    for (int k = 0; k < 200; ++k) {
      const RingPair pair = random.pair(nearness);
      const double K = polygon_pair(pair.a, pair.b, 1e-14).value;
      if (!well_posed(pair, K)) continue;
      const auto [a1, a2] = split(pair.a, random);
      const auto [b1, b2] = split(pair.b, random);
      double sum = 0;
      for (const Ring& a : {a1, a2})
        for (const Ring& b : {b1, b2}) sum += polygon_pair(a, b, 1e-14).value;
      EXPECT_NEAR(sum / K, 1.0, 1e-12);
      ++compared;
    }
  }
  EXPECT_GT(compared, 200);
}

/// The triangles of the convex hull of random points on a sphere, seen from inside; their areas differ by more than a
/// hundred.
std::vector<Ring> random_polyhedron(std::uint64_t seed, int corners) {
  RandomPairs random(seed);
  std::vector<Vec3> points;
  for (int k = 0; k < corners; ++k) points.push_back(random.direction().cwiseProduct(Vec3(1, 2, .7)));
  std::vector<Ring> triangles;
  for (const Vec3& p : points)
    for (const Vec3& q : points)
      for (const Vec3& r : points) {
        if (!(&p < &q && &p < &r && &q != &r)) continue;
        const Vec3 n = (q - p).cross(r - p);
        bool inside = true;
        for (const Vec3& x : points) inside = inside && (&x == &p || &x == &q || &x == &r || n.dot(x - p) > 0);
        if (inside) triangles.push_back({p, q, r});
      }
  return triangles;
}

TEST(ClosedFormPairs, of_random_convex_polyhedra_sum_to_one) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto triangles = random_polyhedron(seed, 12);
    ASSERT_EQ(triangles.size(), 20u);
    std::vector<scene::SurfacePatch> patches;
    for (const Ring& ring : triangles) patches.push_back(patch(static_cast<std::uint32_t>(patches.size()), ring));
    for (const double row : test::unoccluded_row_sums(patches, 1e-11)) EXPECT_NEAR(row, 1.0, 1e-10);
  }
}

// Lengths times 2^k: the same digits, whatever way a pair goes.
TEST(ClosedFormPairs, scale_exactly_by_powers_of_two) {
  for (const Nearness nearness : every_nearness) {
    RandomPairs random(4);
    for (int k = 0; k < 30; ++k) {
      const RingPair pair = random.pair(nearness);
      for (const double tolerance : {1e-3, 1e-6, 1e-12}) {
        const PairIntegral found = integrate(pair.a, pair.b, tolerance);
        for (const int power : {-20, 7}) {
          const double scale = std::ldexp(1.0, power);
          const PairIntegral other = integrate(scaled(pair.a, scale), scaled(pair.b, scale), tolerance);
          EXPECT_EQ(other.value, std::ldexp(found.value, 2 * power));
          EXPECT_EQ(other.error, std::ldexp(found.error, 2 * power));
        }
      }
    }
  }
  EXPECT_EQ(rectangle_pair(scaled(low, 1024), scaled(high, 1024))->value,
            std::ldexp(rectangle_pair(low, high)->value, 20));
}

TEST(ClosedFormPairs, agree_with_the_double_contour_and_with_lambert_quadrature) {
  for (const Nearness nearness : every_nearness) {
    RandomPairs random(5);
    for (int k = 0; k < 100; ++k) {
      const RingPair pair = random.pair(nearness);
      const Integral closed = polygon_pair(pair.a, pair.b, 1), contour = double_contour(pair.a, pair.b);
      EXPECT_NEAR(closed.value, contour.value, 2 * (closed.error + contour.error));
      const Integral lambert = adaptive_lambert(pair.a, normal_of(pair.a), pair.b, 1e-5);
      EXPECT_NEAR(lambert.value, contour.value, 4 * (lambert.error + contour.error));
    }
  }
}

/// Two rectangles of a box, in parallel or perpendicular planes, at random offsets; may touch.
RingPair random_rectangles(RandomPairs& random) {
  const auto interval = [&] {
    const double from = std::floor(4 * random.next()) / 4, length = .1 + random.next();
    return std::pair{from, from + length};
  };
  const auto [x0, x1] = interval();
  const auto [y0, y1] = interval();
  const auto [u0, u1] = interval();
  const auto [v0, v1] = interval();
  const Ring a{{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}};
  if (random.next() < .5) {
    const double z = std::pow(10.0, 1 - 4 * random.next());
    return {turned(a), turned({{u0, v0, z}, {u0, v1, z}, {u1, v1, z}, {u1, v0, z}})};
  }
  return {turned(a), turned({{0, v0, u0}, {0, v1, u0}, {0, v1, u1}, {0, v0, u1}})};
}

TEST(RectanglePair, is_the_polygons_closed_form_at_any_offset) {
  RandomPairs random(6);
  for (int k = 0; k < 500; ++k) {
    const RingPair pair = random_rectangles(random);
    const auto rectangles = rectangle_pair(pair.a, pair.b), swapped = rectangle_pair(pair.b, pair.a);
    ASSERT_TRUE(rectangles && swapped);
    const Integral polygons = polygon_pair(pair.a, pair.b, 1);
    EXPECT_NEAR(rectangles->value, polygons.value, 2 * (rectangles->error + polygons.error));
    EXPECT_NEAR(rectangles->value, swapped->value, 2 * (rectangles->error + swapped->error));
  }
}

TEST(RectanglePair, is_of_rectangles_with_common_axes_alone) {
  const Ring trapezoid = {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1.001, 0, 1}},
             askew = {{0, 0, 1}, {-.1, 1, 1}, {.9, 1.1, 1}, {1, .1, 1}};
  EXPECT_FALSE(rectangle_pair(unit_square, triangle_above));
  EXPECT_FALSE(rectangle_pair(unit_square, trapezoid));
  EXPECT_FALSE(rectangle_pair(trapezoid, unit_square));
  EXPECT_FALSE(rectangle_pair(unit_square, askew));
  EXPECT_FALSE(rectangle_pair(unit_square, Ring{{0, 0, 1}, {0, 1, 1}, {1, 1, 1.001}, {1, 0, 1.001}}));
}

void expect_bounded(const Ring& a, const Ring& b) {
  for (const double tolerance : {1e-3, 1e-9}) {
    const PairIntegral found = integrate(a, b, tolerance);
    EXPECT_GE(found.value, 0.0);
    EXPECT_LE(found.value, std::min(area_of(a), area_of(b)));
    EXPECT_TRUE(std::isfinite(found.error));
  }
}

/// Both against a sliver of width 1e-9 of each, in and above the other's plane, and far from the origin.
TEST(ClosedFormPairs, of_slivers_and_far_from_the_origin_stay_in_bounds) {
  for (const Nearness nearness : every_nearness) {
    RandomPairs random(7);
    for (int k = 0; k < 5; ++k) {
      const RingPair pair = random.pair(nearness);
      const Ring sliver{pair.b[0], pair.b[1], pair.b[1] + 1e-9 * (pair.b[2] - pair.b[1]),
                        pair.b[0] + 1e-9 * (pair.b[2] - pair.b[0])};
      const Ring needle{pair.b[0], pair.b[1], pair.b[1] + 1e-9 * (pair.b[2] - pair.b[1])};
      expect_bounded(pair.a, sliver);
      expect_bounded(needle, pair.a);
      expect_bounded(scaled(pair.a, 1, {1e9, -1e9, 1e9}), scaled(pair.b, 1, {1e9, -1e9, 1e9}));
    }
  }
}

// A sliver is a line: K = width int F_{dA -> a} ds, within width / length of it.
TEST(ClosedFormPairs, of_a_sliver_is_its_width_times_a_line_integral) {
  const double width = 1e-9;
  const Ring sliver{{.1, .1, .4}, {.1, .1 + width, .4}, {.7, .1 + width, .4}, {.7, .1, .4}};
  const Ring wide{{.1, .1, .4}, {.1, .1 + 1e-4, .4}, {.7, .1 + 1e-4, .4}, {.7, .1, .4}};
  EXPECT_NEAR(integrate(unit_square, sliver, 1e-6).value / width, integrate(unit_square, wide, 1e-6).value / 1e-4,
              1e-4);
}

TEST(ClosedFormPairs, in_one_plane_or_edge_on_are_nothing) {
  const Ring beside_in_plane = {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}},
             hinged_flat = {{0, 0, 0}, {0, 1, 0}, {-1, 1, 1e-9}, {-1, 0, 1e-9}};
  EXPECT_EQ(integrate(unit_square, beside_in_plane, 1e-6).value, 0.0);
  expect_bounded(unit_square, hinged_flat);
  const Ring edge_on = {{2, 0, 0}, {2, 1, 0}, {2, 1, 1e-9}, {2, 0, 1e-9}};
  expect_bounded(unit_square, Ring(edge_on.rbegin(), edge_on.rend()));
}

// A millimetre apart, each a metre wide: almost all of it, and never more.
TEST(ClosedFormPairs, of_squares_almost_in_touch_are_almost_the_area) {
  for (const double gap : {1e-3, 1e-6, 1e-9}) {
    const PairIntegral found = integrate(unit_square, {{0, 0, gap}, {0, 1, gap}, {1, 1, gap}, {1, 0, gap}}, 1e-9);
    EXPECT_LE(found.value, 1.0);
    EXPECT_NEAR(found.value, 1 - 2 * gap,
                20 * gap * gap * -std::log(gap) + 1e-14);  // what leaves at the rim: half of perimeter times gap
  }
}

}  // namespace
}  // namespace interflect::fem
