#include "core/progress.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace interflect::core {
namespace {

// Stages of many names are the same from one step to the next: whoever waits is told which step it is.
TEST(Progress, names_the_step_before_its_stages) {
  testing::internal::CaptureStderr();
  Progress whole(Progress::Style::lines), step(whole, "path: pixels"), quiet;
  Progress of_quiet(quiet, "light: pixels");
  {
    Progress::Stage stage(step, "path tracing", 2), unheard(of_quiet, "light tracing", 2), plain(whole, "the rest", 2);
    std::this_thread::sleep_for(std::chrono::milliseconds(2100));  // shorter ones stay silent
    stage.advance();
    unheard.advance();
    plain.advance();
  }
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_EQ(told.find("path: pixels, path tracing: 50 %, 2."), 0u) << told;
  EXPECT_EQ(told.find("light"), std::string::npos) << told;
  EXPECT_NE(told.find("\nthe rest: 50 %"), std::string::npos) << told;
}

}  // namespace
}  // namespace interflect::core
