#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/format.h"
#include "core/image.h"
#include "core/random.h"

namespace interflect::core {
namespace {

TEST(Text, numbers_are_shown_as_people_say_them) {
  EXPECT_EQ(format("%d %s", 3, "rays"), "3 rays");
  EXPECT_EQ(format_bytes(2.04e9), "2.0 GB");
  EXPECT_EQ(format_duration(0.44), "0.4 s");
  EXPECT_EQ(format_duration(150), "2 min");
  EXPECT_EQ(format_duration(7200), "2.0 h");
  EXPECT_EQ(format_count(12512345), "12 512 345");
  EXPECT_EQ(format_count(999), "999");
}

TEST(Text, a_message_is_one_line) { EXPECT_EQ(single_line("  bad\n  thing\there \n"), "bad thing here"); }

TEST(Image, pictures_stand_beside_each_other) {
  Image a(2, 1, {"Y"}), b(1, 1, {"Y"});
  a.at(1, 0, 0) = 0.25F;
  b.at(0, 0, 0) = 0.5F;
  const Image both = side_by_side({a, b}, 1);
  ASSERT_EQ(both.width, 4);
  EXPECT_EQ(both.at(1, 0, 0), 0.25F);
  EXPECT_EQ(both.at(2, 0, 0), 1.0F);
  EXPECT_EQ(both.at(3, 0, 0), 0.5F);
  EXPECT_THROW(side_by_side({a, Image(1, 2, {"Y"})}, 0), PreconditionError);
}

TEST(Format, rounds_bounds_up_and_never_down) {
  EXPECT_EQ(rounded_up(3.149, 2), 3.2);
  EXPECT_EQ(rounded_up(3.1, 2), 3.1);
  EXPECT_EQ(rounded_up(0.0991, 1), 0.1);
  EXPECT_EQ(rounded_up(9.96, 2), 10);
  EXPECT_EQ(rounded_up(1.0000001e-7, 3), 1.01e-7);
  EXPECT_EQ(rounded_up(0, 2), 0);
  EXPECT_TRUE(std::isinf(rounded_up(std::numeric_limits<double>::infinity(), 2)));
  RandomNumbers random(8, 0, 0);
  for (int k = 0; k < 10000; ++k) {
    const double value = std::pow(10.0, 12 * random.next() - 6), told = rounded_up(value, 2);
    ASSERT_GE(told, value);
    ASSERT_LE(told, value * 1.100001);
  }
}

}  // namespace
}  // namespace interflect::core
