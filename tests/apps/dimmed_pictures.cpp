#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/apps/program.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace interflect::test {
namespace {

/// Bytes of red, green and blue, row after row.
struct Bytes {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;
  unsigned char at(int x, int y, int c) const { return rgb[static_cast<std::size_t>(3 * (y * width + x) + c)]; }
  unsigned char brightest_around(int x, int y) const {  // the pixel and its neighbours
    unsigned char most = 0;
    for (int j = std::max(0, y - 1); j < std::min(height, y + 2); ++j)
      for (int i = std::max(0, x - 1); i < std::min(width, x + 2); ++i) most = std::max(most, at(i, j, 0));
    return most;
  }
};

Bytes read_bytes(const std::filesystem::path& file) {
  Bytes bytes;
  int channels = 0;
  unsigned char* const data = stbi_load(file.c_str(), &bytes.width, &bytes.height, &channels, 3);
  EXPECT_NE(data, nullptr) << file;
  if (data == nullptr) return bytes;
  bytes.rgb.assign(data, data + 3 * bytes.width * bytes.height);
  stbi_image_free(data);
  return bytes;
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
    const Bytes own = read_bytes(lit / name), full = read_bytes(folder / "full" / name);
    ASSERT_GT(own.height, 0);
    ASSERT_GT(full.height, own.height) << name << " has no line below it";
    int off = 0;
    for (int y = 0; y < own.height; ++y)
      for (int x = 0; x < own.width; ++x)
        for (int c = 0; c < 3; ++c) off += full.at(x, y, c) != own.at(x, y, c);
    EXPECT_EQ(off, 0) << name;
  }
  const Bytes brighter = read_bytes(folder / "40%" / "radiosity.png"),
              darker = read_bytes(folder / "20%" / "radiosity.png");
  ASSERT_EQ(brighter.rgb.size(), darker.rgb.size());
  const double part = std::pow(0.5, 1 / 2.4), shift = 0.055 * 255;
  constexpr int height = 500;  // of the camera; words are below
  int compared = 0, off = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < brighter.width; ++x) {
      if (brighter.brightest_around(x, y) > 240) continue;  // the lamp
      ++compared;
      off += std::abs(darker.at(x, y, 0) + shift - part * (brighter.at(x, y, 0) + shift)) > 1 + part;
    }
  EXPECT_GT(compared, 50000);
  EXPECT_EQ(off, 0);
}

}  // namespace
}  // namespace interflect::test
