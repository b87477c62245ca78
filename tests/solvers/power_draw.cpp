#include "solvers/power_draw.h"

#include <gtest/gtest.h>

#include "tests/solvers/random_systems.h"

namespace interflect::solvers {
namespace {

// Intervals of u, in the order of the unknowns, as long as their shares; what sends nothing is never drawn.
TEST(PowerDraw, maps_shares_onto_unknowns) {
  ColumnMatrix power = random_columns(200, 2, 0, 1, 81);
  for (Index a = 0; a < 200; a += 3) power.row(a).setZero();
  power.row(1) *= 1e4;
  power.row(199).setZero();
  const PowerDraw draw(power);
  const Eigen::VectorXd shares = (power.col(0) / power.col(0).sum() + power.col(1) / power.col(1).sum()) / 2;
  double before = 0;
  for (Index a = 0; a < 200; ++a) {
    if (shares(a) == 0) continue;
    for (const double part : {1e-6, .5, 1 - 1e-6}) {
      const auto [drawn, probability] = draw(before + part * shares(a));
      EXPECT_EQ(drawn, a) << part;
      EXPECT_NEAR(probability, shares(a), 1e-13);
    }
    before += shares(a);
  }
  EXPECT_EQ(draw(0).unknown, 1);
  EXPECT_EQ(draw(1 - 0x1p-53).unknown, 197);
}

// Beside every place where another part of the guide begins, with long runs of what sends nothing, and with much by one.
TEST(PowerDraw, is_what_a_search_through_all_finds) {
  for (const Index n : {1, 2, 3, 7, 100, 1021}) {
    ColumnMatrix power = random_columns(n, 1, 0, 1, 82);
    for (Index a = 0; a < n; ++a)
      if (a % 5 == 3 || a > n / 2 + 1) power(a, 0) = 0;
    power(n / 3, 0) = 1e3;
    const PowerDraw draw(power);
    const double all = power.sum();
    const auto searched = [&](double u) {
      double sum = 0;
      for (Index a = 0; a < n; ++a)
        if ((sum += power(a, 0)) > u * all) return a;
      return n;
    };
    for (Index k = 0; k < n; ++k)
      for (const double beside : {-1e-9, 1e-9}) {
        const double u = (static_cast<double>(k) + .5 + .5 * beside) / static_cast<double>(n),
                     at = double(k) / double(n) + beside;
        EXPECT_EQ(draw(u).unknown, searched(u)) << n << ' ' << k;
        if (at >= 0) {
          EXPECT_EQ(draw(at).unknown, searched(at)) << n << ' ' << k;
        }
      }
    EXPECT_GT(power(draw(1 - 0x1p-53).unknown, 0), 0);
    EXPECT_GT(power(draw(0).unknown, 0), 0);
  }
}

TEST(PowerDraw, of_one_and_of_nothing) {
  EXPECT_EQ(PowerDraw(ColumnMatrix::Ones(1, 1))(.7).unknown, 0);
  EXPECT_TRUE(PowerDraw(ColumnMatrix::Zero(5, 2)).nothing());
}

}  // namespace
}  // namespace interflect::solvers
