#include "visual/plot.h"

#include <gtest/gtest.h>

#include <limits>

using namespace interflect;

namespace {

/// Pixels in which two pictures differ.
int differing(const core::Image& a, const core::Image& b) {
  int count = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      bool same = true;
      for (int c = 0; c < 3; ++c) same = same && a.at(x, y, c) == b.at(x, y, c);
      count += !same;
    }
  return count;
}

visual::Plot plot(std::vector<double> x, std::vector<double> y) {
  return {"title", "x", "y", {{"", std::move(x), std::move(y)}}};
}

}  // namespace

// The frame spans 90 .. 670 across and 560 .. 50 up: (1, 1) of decades 0.1 .. 10 lies in its middle.
TEST(Plot, puts_points_where_their_logarithms_are) {
  const core::Image picture = visual::plot_picture(plot({0.1, 1, 10}, {0.1, 1, 10}));
  EXPECT_EQ(picture.width, 1040);
  EXPECT_EQ(picture.height, 620);
  EXPECT_NEAR(picture.at(380, 305, 0), 31 / 255.0, 1e-6);
  EXPECT_NEAR(picture.at(380, 305, 2), 180 / 255.0, 1e-6);
  EXPECT_NEAR(picture.at(235, 432, 0), 31 / 255.0, 0.2);  // on the line between
  EXPECT_EQ(picture.at(300, 200, 0), 1);                  // beside it
}

TEST(Plot, leaves_out_what_has_no_logarithm) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const core::Image good = visual::plot_picture(plot({0.2, 5}, {0.2, 5}));
  EXPECT_EQ(differing(good, visual::plot_picture(plot({0.2, 0, nan, 1, inf, 5}, {0.2, 1, 1, -1, 1, 5}))), 0);
  EXPECT_GT(differing(good, visual::plot_picture(plot({}, {}))), 100);
}

TEST(Plot, many_curves_are_in_panels_with_axes_of_their_own_and_few_in_one) {
  visual::Plot both = plot({0.1, 1, 10}, {0.1, 1, 10});
  for (int k = 1; k < 9; ++k) {
    EXPECT_EQ(visual::plot_picture(both).height, 620);
    both.curves.push_back({"", {1e3, 1e4, 1e5}, {1e3, 1e4, 1e5}, "second"});
  }
  const core::Image picture = visual::plot_picture(both);
  EXPECT_EQ(picture.height, 2 * 620);
  EXPECT_NEAR(picture.at(380, 305, 2), 180 / 255.0, 1e-6);  // the first curve's colour
  EXPECT_LT(picture.at(235, 432, 0), 0.4);                  // on its line
  EXPECT_LT(picture.at(235, 620 + 432, 2), 0.8);            // on the others'
}

TEST(Plot, curves_that_lie_on_each_other_both_show) {
  visual::Plot both = plot({0.1, 1, 10}, {0.1, 1, 10});
  both.curves.push_back({"", {0.1, 1, 10}, {0.1, 1, 10}});
  const core::Image picture = visual::plot_picture(both),
                    first = visual::plot_picture(plot({0.1, 1, 10}, {0.1, 1, 10}));
  EXPECT_NEAR(picture.at(381, 304, 2), first.at(381, 304, 2),
              1e-6);  // a full marker within the hollow one of the second
  EXPECT_GT(differing(picture, first), 300);
}
