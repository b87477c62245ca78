#include "core/log.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace interflect::core {
namespace {

// What a method says with each of many settings is said once; what a quiet run has not said is not taken for said.
TEST(Log, a_warning_that_is_the_last_one_again_is_said_once) {
  const auto lines_of = [](const auto& say) {
    testing::internal::CaptureStderr();
    say();
    const std::string said = testing::internal::GetCapturedStderr();
    return std::count(said.begin(), said.end(), '\n');
  };
  EXPECT_EQ(lines_of([] {
              for (int k = 0; k < 3; ++k) log::warning("near");
            }),
            1);
  EXPECT_EQ(lines_of([] {
              for (const char* text : {"far", "near", "far"}) log::warning(text);
            }),
            3);
  log::set_level(log::Level::quiet);
  EXPECT_EQ(lines_of([] {
              log::warning("short of it");
              log::shortfall("short of it");
            }),
            1);
  log::set_level(log::Level::info);
}

}  // namespace
}  // namespace interflect::core
