#include "core/ordered_sum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.h"

namespace interflect::core {
namespace {

// The same values at eight places relative to a line of the cache, of all lengths up to a few registers and some more.
TEST(OrderedSum, has_the_same_bits_wherever_the_values_lie) {
  RandomNumbers random(7, 0, 0);
  for (const Index n : {0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33, 64, 1000, 4132}) {
    const Eigen::VectorXd values = Eigen::VectorXd::NullaryExpr(n, [&] { return random.next() - 0.4; });
    long double exact = 0;
    for (const double v : values) exact += static_cast<long double>(v);
    std::vector<double> room(static_cast<std::size_t>(n + 8));
    double first = 0;
    for (Index shift = 0; shift < 8; ++shift) {
      Eigen::Map<Eigen::VectorXd> there(room.data() + shift, n);
      there = values;
      const double sum = ordered_sum(there);
      if (shift == 0) first = sum;
      EXPECT_EQ(sum, first) << n << ' ' << shift;
    }
    EXPECT_NEAR(first, static_cast<double>(exact), 1e-16 * static_cast<double>(n * n + 1));
  }
}

}  // namespace
}  // namespace interflect::core
