#include "results/colour_map.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace interflect::results;

TEST(ColourMap, lightness_grows_with_the_number) {
  for (ColourMap map : {ColourMap::plasma, ColourMap::viridis, ColourMap::inferno}) {
    double before = -1;
    for (int i = 0; i <= 64; ++i) {
      const Colour c = colour_of(map, i / 64.0);
      const double light = 0.2126 * std::pow(c[0], 2.2) + 0.7152 * std::pow(c[1], 2.2) + 0.0722 * std::pow(c[2], 2.2);
      EXPECT_GT(light, before * 0.999) << i;
      before = light;
    }
  }
}

TEST(ColourMap, blue_is_low_and_red_or_yellow_is_high) {
  const Colour low = colour_of(ColourMap::plasma, 0), high = colour_of(ColourMap::plasma, 1);
  EXPECT_GT(low[2], 2 * low[0]);
  EXPECT_GT(high[0], 2 * high[2]);
  EXPECT_EQ(colour_of(ColourMap::blue_white_red, 0.5), (Colour{247, 247, 247}));
  EXPECT_EQ(colour_of(ColourMap::plasma, std::nan("")), no_data);
  EXPECT_EQ(colour_of(ColourMap::plasma, 7), high);
}
