#include "results/comparison_panels.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "core/random.h"
#include "results/colour_map.h"

using namespace interflect;
using namespace interflect::results;

namespace {

scene::Scene two_bands() {
  scene::Scene scene;
  scene.channels = {"visible", "heat"};
  scene.weights[0] = 1;  // and 0
  return scene;
}

core::Image even(float visible, float heat, int width = 13, int height = 7) {
  core::Image image(width, height, {"visible", "heat"});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.at(x, y, 0) = visible, image.at(x, y, 1) = heat;
  return image;
}

Colour colour_at(const core::Image& image, int x, int y) {
  Colour out;
  for (int c = 0; c < 3; ++c)
    out[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::lround(255 * image.at(x, y, c)));
  return out;
}

}  // namespace

TEST(ComparisonPanels, the_difference_is_relative_to_the_mean_and_of_the_weighted_radiance) {
  // (41 - 39) / 40 = 5 %, half of the full scale; the band without weight differs by more and does not count.
  const ComparisonPanels brighter = comparison_panels(two_bands(), even(41, 1), even(39, 100), even(0.5F, 0), 0.1);
  const ComparisonPanels darker = comparison_panels(two_bands(), even(39, 1), even(41, 100), even(0.5F, 0), 0.1);
  for (const auto& [x, y] : {std::pair{0, 0}, {12, 6}}) {  // the last block is smaller than the others
    EXPECT_EQ(colour_at(brighter.difference, x, y), colour_of(ColourMap::blue_white_red, 0.75));
    EXPECT_EQ(colour_at(darker.difference, x, y), colour_of(ColourMap::blue_white_red, 0.25));
  }
}

TEST(ComparisonPanels, noise_of_single_pixels_is_averaged_and_darkness_agrees) {
  core::Image noisy = even(0, 0);
  for (int y = 0; y < noisy.height; ++y)
    for (int x = 0; x < 6; ++x) noisy.at(x, y, 0) = (x + y) % 2 == 0 ? 0.0F : 80.0F;  // 40 in the mean of a 6 x 6 block
  const core::Image smooth = even(40, 0);
  core::Image fem = even(0, 0);
  for (int y = 0; y < fem.height; ++y)
    for (int x = 0; x < 6; ++x) fem.at(x, y, 0) = smooth.at(x, y, 0);
  const core::Image difference = comparison_panels(two_bands(), fem, noisy, even(0, 0), 0.1).difference;
  EXPECT_EQ(colour_at(difference, 3, 3), colour_of(ColourMap::blue_white_red, 0.5));
  EXPECT_EQ(colour_at(difference, 9, 3), colour_of(ColourMap::blue_white_red, 0.5));
}

TEST(ComparisonPanels, what_noise_may_explain_stays_white) {
  // 36 pixels of a standard error s each: that of their mean is s / 6, and 2 is more than three of them below s = 4.
  const Colour white = colour_of(ColourMap::blue_white_red, 0.5), half = colour_of(ColourMap::blue_white_red, 0.75);
  EXPECT_EQ(colour_at(comparison_panels(two_bands(), even(41, 1), even(39, 1), even(3.9F, 0), 0.1).difference, 0, 0),
            half);
  EXPECT_EQ(colour_at(comparison_panels(two_bands(), even(41, 1), even(39, 1), even(4.1F, 0), 0.1).difference, 0, 0),
            white);
  const auto unknown = std::numeric_limits<float>::infinity();
  EXPECT_EQ(
      colour_at(comparison_panels(two_bands(), even(41, 1), even(39, 1), even(unknown, unknown), 0.1).difference, 0, 0),
      white);
}

TEST(ComparisonPanels, what_neighbours_err_by_together_is_not_averaged) {
  // A block errs by as much as its pixels: 2 is more than three errors below s = 2/3, and beside
  // a noise of 2.4 / 6 in the mean below sqrt(4/9 - .16) = .533.
  const auto difference = [](float shared, float noise) {
    const core::Image of_all = even(shared, 0);
    return colour_at(comparison_panels(two_bands(), even(41, 1), even(39, 1), even(noise, 0), 0.1, &of_all).difference,
                     0, 0);
  };
  const Colour white = colour_of(ColourMap::blue_white_red, 0.5), half = colour_of(ColourMap::blue_white_red, 0.75);
  EXPECT_EQ(difference(.66F, 0), half);
  EXPECT_EQ(difference(.67F, 0), white);
  EXPECT_EQ(difference(.53F, 2.4F), half);
  EXPECT_EQ(difference(.54F, 2.4F), white);
}

TEST(ComparisonPanels, both_pictures_have_one_exposure_which_single_bright_samples_do_not_darken) {
  const ComparisonPanels panels = comparison_panels(two_bands(), even(1, 0), even(0.5F, 0), even(0, 0), 0.1);
  EXPECT_FLOAT_EQ(panels.fem.at(0, 0, 0), 1) << "cut off";
  EXPECT_FLOAT_EQ(panels.traced.at(0, 0, 0), 1);
  core::Image specks = even(0.5F, 0);
  for (int y = 0; y < specks.height; y += 3) specks.at(0, y, 0) = 1000;
  const ComparisonPanels beside_specks = comparison_panels(two_bands(), even(1, 0), specks, even(0, 0), 0.1);
  EXPECT_FLOAT_EQ(beside_specks.fem.at(0, 0, 0), 1);
  EXPECT_NEAR(beside_specks.traced.at(1, 1, 0), 0.735357, 1e-6);  // sRGB of 0.5
  EXPECT_THROW(comparison_panels(two_bands(), even(1, 1), even(1, 1, 5, 5), even(1, 1), 0.1), core::PreconditionError);
}

namespace {

/// Errors of 1 a pixel, each pixel of its own, by twelve uniform numbers; a loss of so many errors of a block's mean in
/// every third block column.
core::Image noisy(std::uint64_t seed, double loss) {
  constexpr int side = 60;
  core::Image image(side, side, {"visible", "heat"});
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      core::RandomNumbers random(seed, 0, static_cast<std::uint64_t>(y * side + x));
      double noise = -6;
      for (int k = 0; k < 12; ++k) noise += random.next();
      image.at(x, y, 0) = static_cast<float>(100 + noise - (x / 6 % 3 == 0 ? loss / 6 : 0));
    }
  return image;
}

BlocksApart apart(std::uint64_t seed, double loss) {
  return comparison_panels(two_bands(), even(100, 0, 60, 60), noisy(seed, loss), even(1, 0, 60, 60), 0.1).apart;
}

}  // namespace

// P(Binomial(100, .0027) > 2) = .0026, and > 1 = .030: the level is .005 to either side.
TEST(ComparisonPanels, count_blocks_that_are_not_white_and_how_many_chance_explains) {
  EXPECT_EQ((BlocksApart{100, 2, 0}).by_chance(), 2u);
  EXPECT_TRUE((BlocksApart{100, 2, 2}).is_explained());
  EXPECT_FALSE((BlocksApart{100, 3, 0}).is_explained());
  EXPECT_FALSE((BlocksApart{100, 0, 3}).is_explained());
  EXPECT_EQ((BlocksApart{}).by_chance(), 0u);
  EXPECT_TRUE(BlocksApart{}.is_explained());
  const std::size_t many = BlocksApart{1'000'000}.by_chance();  // 2700 +- 52, 2.58 of them
  EXPECT_NEAR(static_cast<double>(many), 2700 + 2.576 * 51.9, 10);
}

// 200 innocent pictures: .5 are expected to be blamed, more than 4 with a probability of 2e-4.
TEST(ComparisonPanels, know_what_errors_explain_from_what_they_do_not) {
  int blamed = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) blamed += !apart(seed, 0).is_explained();
  EXPECT_LE(blamed, 4);
  const BlocksApart lost = apart(1, 4);  // 40 blocks darker by 4 errors, of which 84 % are beyond 3
  EXPECT_EQ(lost.blocks, 100u);
  EXPECT_GE(lost.brighter, 24u);  // 34 +- 2.3, four of them
  EXPECT_LE(lost.darker, 2u);
  EXPECT_FALSE(lost.is_explained());
}

// Light that is met by one sample in ten, 16 of which a pixel has, and errors of what they met: 576 samples a block.  Of
// 100 blocks more than 2 are beyond to one side with a probability of .005 at most, were each .0027; 100 pictures of two
// sides expect one at most to be blamed, and more than 5 with a probability of 6e-4.
TEST(ComparisonPanels, do_not_blame_errors_that_are_themselves_estimated) {
  constexpr int side = 60, samples = 16;
  const auto drawn = [](std::uint64_t seed, core::Image& error) {
    core::Image image(side, side, {"visible", "heat"});
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        core::RandomNumbers random(seed, 0, static_cast<std::uint64_t>(y * side + x));
        double met = 0;
        for (int k = 0; k < samples; ++k) met += random.next() < .1 ? 1 : 0;
        const double mean = met / samples;
        image.at(x, y, 0) = static_cast<float>(10 * mean);
        error.at(x, y, 0) =
            std::hypot(error.at(x, y, 0), static_cast<float>(10 * std::sqrt(mean * (1 - mean) / (samples - 1))));
      }
    return image;
  };
  int blamed = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    core::Image error(side, side, {"visible", "heat"});
    const core::Image one = drawn(2 * seed, error), other = drawn(2 * seed + 1, error);
    blamed += !comparison_panels(two_bands(), one, other, error, .1).apart.is_explained();
  }
  EXPECT_LE(blamed, 5);
}

// A black background differs from nothing: the same few blocks are blamed with it and without.
TEST(ComparisonPanels, count_blocks_with_light_alone) {
  core::Image one = even(0, 0, 600, 600), other = even(0, 0, 600, 600), error = even(0, 0, 600, 600);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x) {
      one.at(x, y, 0) = 1, other.at(x, y, 0) = x < 24 && y < 6 ? .5F : 1;
      error.at(x, y, 0) = .1F;
    }
  const BlocksApart found = comparison_panels(two_bands(), one, other, error, .1).apart;
  EXPECT_EQ(found.blocks, 100u);
  EXPECT_EQ(found.brighter, 4u);
  EXPECT_FALSE(found.is_explained());
}

TEST(ComparisonPanels, show_a_picture_beside_one_without_light) {
  const ComparisonPanels panels = comparison_panels(two_bands(), even(100, 0), even(0, 0), even(0, 0), .1);
  EXPECT_FLOAT_EQ(panels.fem.at(0, 0, 0), 1);
  core::Image ramp = even(100, 0);
  ramp.at(0, 0, 0) = 50;
  EXPECT_NEAR(comparison_panels(two_bands(), ramp, even(0, 0), even(0, 0), .1).fem.at(0, 0, 0), 0.735357, 1e-6);
}
