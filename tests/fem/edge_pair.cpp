#include "fem/form_factor/edge_pair.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fem/form_factor/contour.h"
#include "tests/fem/random_pairs.h"

namespace interflect::fem {
namespace {

/// Both ways give the same, and say how well.
void expect_agreement(const Edge& e, const Edge& f) {
  const Integral closed = edge_pair(e, f), numerical = edge_pair_by_quadrature(e, f);
  EXPECT_NEAR(closed.value, numerical.value, 2 * (closed.error + numerical.error) + 2e-16)
      << e.from.transpose() << " to " << e.to.transpose() << ", " << f.from.transpose() << " to " << f.to.transpose();
}

class RandomEdges {
 public:
  Vec3 point() { return Vec3(random_.next(), random_.next(), random_.next()); }
  Vec3 direction() { return random_.direction(); }
  double next() { return random_.next(); }
  double small() { return std::pow(10.0, -17 * random_.next()); }

 private:
  test::RandomPairs random_{3};
};

// int_0^L int_0^L ln|s - t| ds dt = L² (ln L - 3/2)
TEST(EdgePair, of_a_shared_edge_is_known) {
  for (const double L : {1.0, 0.3}) {
    const Edge e = edge_between({0, 0, 0}, {0, L, 0}), back = edge_between({0, L, 0}, {0, 0, 0});
    EXPECT_NEAR(edge_pair(e, e).value, L * L * (std::log(L) - 1.5), 1e-16);
    EXPECT_NEAR(edge_pair(e, back).value, -L * L * (std::log(L) - 1.5), 1e-16);
    EXPECT_NEAR(edge_pair_by_quadrature(e, back).value, -L * L * (std::log(L) - 1.5), 1e-16);
  }
}

// Two edges of a unit square: int int ln(s² + t²) / 2 at 60 degrees, and end to end: int_0^1 int_1^2 ln|s - t| = 2 ln 2
// - 3/2.
TEST(EdgePair, of_edges_on_one_line_is_known) {
  const Edge first = edge_between({0, 0, 0}, {1, 0, 0}), next = edge_between({1, 0, 0}, {2, 0, 0});
  EXPECT_NEAR(edge_pair(first, next).value, 2 * std::log(2.0) - 1.5, 1e-15);
  expect_agreement(first, next);
  expect_agreement(first, edge_between({.2, 0, 0}, {1.7, 0, 0}));
  expect_agreement(first, edge_between({.8, 0, 0}, {.1, 0, 0}));
}

TEST(EdgePair, at_a_right_angle_is_nothing) {
  EXPECT_EQ(edge_pair(edge_between({0, 0, 0}, {1, 0, 0}), edge_between({0, 0, .5}, {0, 1, .5})).value, 0.0);
}

TEST(EdgePair, closed_form_and_quadrature_agree_at_random_lines) {
  RandomEdges random;
  for (int k = 0; k < 2000; ++k)
    expect_agreement(edge_between(random.point(), random.point()), edge_between(random.point(), random.point()));
}

TEST(EdgePair, closed_form_and_quadrature_agree_where_edges_meet_or_nearly_do) {
  RandomEdges random;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 corner = random.point(), near = corner + random.small() * random.direction();
    expect_agreement(edge_between(corner, random.point()), edge_between(random.point(), corner));
    expect_agreement(edge_between(corner, random.point()), edge_between(near, random.point()));
    const Vec3 end = random.point(), between = corner + random.next() * (end - corner);
    expect_agreement(edge_between(corner, end), edge_between(between, random.point()));
    const Vec3 beyond = between + random.next() * (between - random.point());
    expect_agreement(edge_between(corner, end), edge_between(random.point(), beyond));
  }
}

TEST(EdgePair, closed_form_and_quadrature_agree_where_edges_are_parallel_or_nearly_so) {
  RandomEdges random;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 from = random.point(), to = random.point(), shift = random.point();
    expect_agreement(edge_between(from, to), edge_between(to + shift, from + shift));
    expect_agreement(edge_between(from, to),
                     edge_between(to + shift, from + shift + random.small() * random.direction()));
    expect_agreement(edge_between(from, to), edge_between(to, from + random.small() * random.direction()));
  }
}

TEST(EdgePair, of_an_edge_without_length_is_nothing) {
  const Edge e = edge_between({0, 0, 0}, {1, 0, 0}), point = edge_between({0, 1, 0}, {0, 1, 0});
  EXPECT_EQ(edge_pair(e, point).value, 0.0);
  EXPECT_EQ(edge_pair_by_quadrature(point, e).value, 0.0);
}

}  // namespace
}  // namespace interflect::fem
