#include "results/difference_layers.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "results/image_file.h"
#include "tests/support/temporary_folder.h"

namespace interflect::results {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

core::Image row_of(const std::vector<std::string>& channels, const std::vector<float>& data) {
  core::Image image(static_cast<int>(data.size() / channels.size()), 1, channels);
  image.data = data;
  return image;
}

// By hand: .3 and .4 make .5.
TEST(DifferenceLayers, are_differences_their_errors_and_what_is_between_them) {
  const auto a = row_of({"r", "y"}, {3, 1}), b = row_of({"r", "y"}, {1, 2});
  const auto error_a = row_of({"r", "y"}, {.3F, .6F}), error_b = row_of({"r", "y"}, {.4F, .8F});
  const core::Image layers = difference_layers({a, error_a}, {b, error_b});
  EXPECT_EQ(layers.channels, (std::vector<std::string>{"r", "y", "r.error", "y.error", "r.z", "y.z"}));
  const std::vector<float> expected{2, -1, .5F, 1, 4, -1};
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(layers.data[k], expected[k], 1e-6) << k;

  const test::TemporaryFolder folder;
  write_image(folder / "difference.exr", layers);
  const core::Image read = read_exr(folder / "difference.exr");
  EXPECT_EQ(read.channels, (std::vector<std::string>{"R", "y", "r.error", "y.error", "r.z", "y.z"}));
  EXPECT_EQ(read.data, layers.data);
}

TEST(DifferenceLayers, have_a_z_where_there_are_no_errors_and_where_none_is_known) {
  const auto a = row_of({"y"}, {1, 2, 1, 1}), b = row_of({"y"}, {1, 1, 2, 2});
  const auto error_a = row_of({"y"}, {0, 0, 0, infinite}), error_b = row_of({"y"}, {0, 0, 0, 1});
  const core::Image layers = difference_layers({a, error_a}, {b, error_b});
  const float expected[] = {0, infinite, -infinite, 0};
  for (int x = 0; x < 4; ++x) EXPECT_EQ(layers.at(x, 0, 2), expected[x]) << x;
}

TEST(DifferenceLayers, refuse_pictures_that_are_not_alike) {
  const auto one = row_of({"y"}, {1}), two = row_of({"y"}, {1, 2}), other = row_of({"x"}, {1});
  EXPECT_THROW(difference_layers({one, one}, {two, two}), core::PreconditionError);
  EXPECT_THROW(difference_layers({one, one}, {one, two}), core::PreconditionError);
  EXPECT_THROW(difference_layers({one, one}, {other, other}), core::PreconditionError);
}

}  // namespace
}  // namespace interflect::results
