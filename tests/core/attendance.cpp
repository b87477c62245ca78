#include "core/attendance.h"

#include <gtest/gtest.h>

using namespace interflect;

namespace {

/// How many of 1000 times were by all of 4.
int times_by_all(double waited) {
  core::Attendance attendance(4);
  int by_all = 0;
  for (int time = 0; time < 1000; ++time) {
    EXPECT_TRUE(attendance.members() == 4 || attendance.members() == 1);
    by_all += attendance.members() == 4 ? 1 : 0;
    attendance.add(1.0, attendance.members() == 4 ? waited : 0.0);
  }
  return by_all;
}

}  // namespace

TEST(Attendance, is_of_all_where_none_waits_long) {
  EXPECT_EQ(times_by_all(0.0), 1000);
  EXPECT_EQ(times_by_all(0.2), 1000);
}

// After 1, 2 alone, 1, 4 alone, 1, 8 .. 1, 64, 1, 64: 1 + 2 + 1 + 4 + .. + 32 = 67 times, 5 of them by all, and then one in 65.
TEST(Attendance, is_of_one_mostly_where_they_wait) { EXPECT_EQ(times_by_all(0.5), 5 + (1000 - 67 + 64) / 65); }

TEST(Attendance, comes_back_when_they_wait_no_more) {
  core::Attendance attendance(2);
  attendance.add(1.0, 0.9);
  for (int time = 0; time < 2; ++time) {
    EXPECT_EQ(attendance.members(), 1u);
    attendance.add(1.0, 0.0);
  }
  for (int time = 0; time < 10; ++time) {
    EXPECT_EQ(attendance.members(), 2u);
    attendance.add(1.0, 0.0);
  }
}

TEST(Attendance, of_one_is_of_one) {
  core::Attendance attendance(1);
  for (const double waited : {0.0, 0.9}) {
    EXPECT_EQ(attendance.members(), 1u);
    attendance.add(1.0, waited);
  }
}
