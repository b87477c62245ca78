#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "results/image_file.h"
#include "tests/apps/program.h"

namespace interflect::test {
namespace {

/// 0 .. 255, as it is in the file.
int byte_at(const core::Image& image, int x, int y, int c) {
  return static_cast<int>(std::lround(255 * image.at(x, y, c)));
}

/// Of the red of a pixel and its neighbours.
int brightest_around(const core::Image& image, int x, int y) {
  int most = 0;
  for (int j = std::max(0, y - 1); j < std::min(image.height, y + 2); ++j)
    for (int i = std::max(0, x - 1); i < std::min(image.width, x + 2); ++i)
      most = std::max(most, byte_at(image, i, j, 0));
  return most;
}

// Light is linear.  sRGB is s = 1.055 x^(1 / 2.4) - 0.055 where x is not tiny, so that s + 0.055 of a pixel at 20 % is
// 0.5^(1 / 2.4) of what it is at 40 %, whatever colours of corners VTK makes it of: within what rounding to bytes does,
// once of corners and once of pixels, and where no corner is clipped, as those of the lamp are.
// At full output pictures are the solve's own, to the byte, and a line below them says what they show.
TEST(DimmedPictures, are_darker_by_what_the_lamps_are_dimmed) {
  const TemporaryFolder folder;
  const std::filesystem::path lit = folder / "lit";
  ASSERT_EQ(interflect({"solve", shipped_scene("cube"), "--element-size", "0.5", "--light-groups", "-o", lit}).status,
            0);
  ASSERT_EQ(interflect({"dim", lit, "-o", folder / "full"}).status, 0);
  for (const std::string part : {"40%", "20%"})
    ASSERT_EQ(interflect({"dim", lit, "--group", "lit=" + part, "-o", folder / part}).status, 0);
  for (const char* name : {"radiosity.png", "irradiance.png"}) {
    const core::Image own = results::read_png(lit / name), full = results::read_png(folder / "full" / name);
    ASSERT_GT(own.height, 0);
    ASSERT_GT(full.height, own.height) << name << " has no line below it";
    int off = 0;
    for (int y = 0; y < own.height; ++y)
      for (int x = 0; x < own.width; ++x)
        for (int c = 0; c < 3; ++c) off += byte_at(full, x, y, c) != byte_at(own, x, y, c);
    EXPECT_EQ(off, 0) << name;
  }
  const core::Image brighter = results::read_png(folder / "40%" / "radiosity.png"),
                    darker = results::read_png(folder / "20%" / "radiosity.png");
  ASSERT_EQ(brighter.data.size(), darker.data.size());
  const double part = std::pow(0.5, 1 / 2.4), shift = 0.055 * 255;
  constexpr int height = 500;  // of the camera; words are below
  int compared = 0, off = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < brighter.width; ++x) {
      if (brightest_around(brighter, x, y) > 240) continue;  // the lamp
      ++compared;
      off += std::abs(byte_at(darker, x, y, 0) + shift - part * (byte_at(brighter, x, y, 0) + shift)) > 1 + part;
    }
  EXPECT_GT(compared, 50000);
  EXPECT_EQ(off, 0);
}

}  // namespace
}  // namespace interflect::test
