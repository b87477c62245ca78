#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/error.h"
#include "results/atomic_file.h"
#include "results/image_file.h"
#include "tests/support/temporary_folder.h"

using namespace interflect;
using namespace interflect::results;

namespace {

core::Image gradient(int width, int height, std::vector<std::string> channels) {
  core::Image image(width, height, std::move(channels));
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<float>(i) * 1.7F + 1e-3F;
  return image;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

}  // namespace

TEST(Images, exr_reads_back_bit_by_bit_in_the_order_of_the_channels) {
  const test::TemporaryFolder scratch;
  for (const auto& channels : {std::vector<std::string>{"r", "g", "b"}, {"uv", "nir", "400nm"}, {"Y"}}) {
    const core::Image image = gradient(37, 11, channels);
    write_image(scratch / "image.exr", image);
    const core::Image back = read_exr(scratch / "image.exr");
    EXPECT_EQ(back.width, 37);
    EXPECT_EQ(back.height, 11);
    EXPECT_EQ(back.data, image.data);
    EXPECT_EQ(back.channels, channels[0] == "r" ? (std::vector<std::string>{"R", "G", "B"}) : channels);
  }
  EXPECT_EQ(scratch.files(), 1u);
}

TEST(Images, channels_that_would_share_a_name_in_an_exr_are_a_bug) {
  EXPECT_THROW(exr_bytes(gradient(2, 2, {"r", "R"})), core::PreconditionError);
}

TEST(Images, what_is_no_exr_is_refused_in_one_line) {
  const test::TemporaryFolder scratch;
  write_atomically(scratch / "image.exr", "this is no image");
  for (const char* name : {"image.exr", "missing.exr"}) try {
      read_exr(scratch / name);
      ADD_FAILURE();
    } catch (const core::InputError& problem) {
      EXPECT_EQ(std::string(problem.what()).find('\n'), std::string::npos);
      EXPECT_NE(std::string(problem.what()).find(name), std::string::npos);
    }
  std::string bytes = exr_bytes(gradient(64, 64, {"Y"}));
  write_atomically(scratch / "cut.exr", bytes.substr(0, bytes.size() / 2));
  EXPECT_THROW(read_exr(scratch / "cut.exr"), core::InputError);
}

TEST(Images, png_has_its_header_and_size) {
  const std::string bytes = png_bytes(core::Image(640, 481, {"r", "g", "b"}));
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(big_endian(bytes, 16), 640u);
  EXPECT_EQ(big_endian(bytes, 20), 481u);
  EXPECT_EQ(bytes[24], 8);  // bits
  EXPECT_EQ(bytes[25], 2);  // true colour
}

TEST(Images, only_known_extensions_are_taken) {
  EXPECT_THROW(require_image_extension("image.jpg"), core::InputError);
  EXPECT_THROW(require_image_extension("image"), core::InputError);
  EXPECT_NO_THROW(require_image_extension("a/image.PNG"));
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "taken.png");
  EXPECT_THROW(require_both_images(folder / "taken.exr"), core::InputError);
  EXPECT_NO_THROW(require_both_images(folder / "free.exr"));
  EXPECT_THROW(write_image("image.jpg", gradient(2, 2, {"Y"})), core::InputError);
}

TEST(Images, tone_mapping_shows_the_99th_percentile_as_white) {
  core::Image image(100, 10, {"r", "g", "b"});
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 100; ++x) image.at(x, y, 1) = static_cast<float>(x + 1) * 5.0F;  // 5 .. 500, the 99th: 495
  EXPECT_DOUBLE_EQ(white_of(image), 495);
  const core::Image shown = tone_mapped(image);
  EXPECT_EQ(shown.at(98, 0, 1), 1.0F);
  EXPECT_EQ(shown.at(99, 0, 1), 1.0F);
  EXPECT_LT(shown.at(97, 0, 1), 1.0F);
  EXPECT_EQ(shown.at(50, 5, 0), 0.0F);
  EXPECT_NEAR(tone_mapped(image, {.white = 1000}).at(99, 0, 1), 0.735357, 1e-6);  // sRGB of 0.5
}

TEST(Images, png_reads_back_byte_by_byte) {
  const test::TemporaryFolder folder;
  core::Image image(16, 16, {"R", "G", "B"});
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<float>(i % 256) / 255;
  write_png(folder / "a.png", image);
  const core::Image read = read_png(folder / "a.png");
  ASSERT_EQ(read.data.size(), image.data.size());
  for (std::size_t i = 0; i < image.data.size(); ++i) EXPECT_FLOAT_EQ(read.data[i], image.data[i]) << i;
  EXPECT_THROW(read_png(folder / "none.png"), core::InputError);
  EXPECT_THROW(read_png(folder.write("text.png", "no picture")), core::InputError);
}

TEST(Images, tone_mapping_survives_darkness_and_what_is_no_number) {
  EXPECT_EQ(tone_mapped(core::Image(3, 3, {"Y"})).at(1, 1, 0), 0.0F);
  core::Image image = gradient(10, 10, {"Y"});
  image.at(3, 3, 0) = std::nanf("");
  image.at(4, 4, 0) = INFINITY;
  EXPECT_TRUE(std::isfinite(white_of(image)));
  EXPECT_EQ(tone_mapped(image).at(3, 3, 0), 0.0F);
  EXPECT_EQ(tone_mapped(image).at(4, 4, 0), 1.0F);
}

TEST(Images, quantiles_are_weighted) {
  const double values[] = {1, 2, 3}, weights[] = {1, 98, 1};
  EXPECT_EQ(weighted_quantile(values, weights, 0.99), 2);
  EXPECT_EQ(weighted_quantile(values, {}, 0.99), 3);
  EXPECT_EQ(weighted_quantile({}, {}, 0.99), 0);
}

// Radiance's own format, by hand: 2 x 1 texels without run lengths, mantissas and a common exponent.
TEST(Images, hdr_is_read_as_radiance_wrote_it) {
  const test::TemporaryFolder scratch;
  const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
  const unsigned char texels[] = {128, 64, 32, 129, 0, 0, 0, 0};
  write_atomically(scratch / "sky.hdr", head + std::string(reinterpret_cast<const char*>(texels), sizeof texels));
  const core::Image image = read_radiance(scratch / "sky.hdr");
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 1);
  EXPECT_EQ(image.channels, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(image.data, (std::vector<float>{1, .5F, .25F, 0, 0, 0}));
  write_atomically(scratch / "bad.hdr", "nothing of the kind");
  EXPECT_THROW(read_radiance(scratch / "bad.hdr"), core::InputError);
  EXPECT_THROW(read_radiance(scratch / "missing.hdr"), core::InputError);
  EXPECT_THROW(read_radiance(scratch / "sky.png"), core::InputError);
}
