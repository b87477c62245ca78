#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace interflect::core {
namespace {

class ThreadCount : public testing::TestWithParam<unsigned> {};

TEST_P(ThreadCount, every_index_is_visited_once) {
  const Threads threads(GetParam());
  std::vector<std::atomic<int>> visits(1003);
  threads.for_blocks(1003, 10, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) ++visits[static_cast<std::size_t>(i)];
  });
  for (const auto& v : visits) EXPECT_EQ(v, 1);
}

TEST_P(ThreadCount, a_sum_has_the_same_bits) {
  const auto sum = [](const Threads& threads) {
    return reduce_in_blocks(threads, 100'000, 64, 0.0, [](Index begin, Index end) {
      double s = 0;
      for (Index i = begin; i < end; ++i) s += std::sin(static_cast<double>(i)) * 1e-3;
      return s;
    });
  };
  EXPECT_EQ(sum(Threads(GetParam())), sum(Threads(1)));
}

TEST_P(ThreadCount, an_exception_reaches_the_caller) {
  const Threads threads(GetParam());
  EXPECT_THROW(threads.for_blocks(100, 1,
                                  [](Index begin, Index) {
                                    if (begin == 50) throw std::runtime_error("here");
                                  }),
               std::runtime_error);
}

TEST_P(ThreadCount, nothing_to_do_is_done) {
  const Threads threads(GetParam());
  threads.for_blocks(0, 10, [](Index, Index) { FAIL(); });
}

INSTANTIATE_TEST_SUITE_P(Counts, ThreadCount, testing::Values(1u, 2u, 3u, 8u));

}  // namespace
}  // namespace interflect::core
