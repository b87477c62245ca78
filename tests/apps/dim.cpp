#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/apps/program.h"

namespace interflect::test {
namespace {

using nlohmann::json;

// At full output all that a solve says of its only group is said again, the part of the noise that elements share too.
TEST(Dim, states_the_errors_of_the_solve_at_full_output) {
  const TemporaryFolder folder;
  ASSERT_EQ(interflect({"solve", shipped_scene("cube"), "--element-size", "0.25", "--form-factors", "hemisphere-rays",
                        "--samples", "256", "--light-groups", "--no-pictures", "-o", folder / "out"})
                .status,
            0);
  ASSERT_EQ(interflect({"dim", folder / "out", "--no-pictures"}).status, 0);
  const json whole = json::parse(read_file(folder / "out/summary.json")),
             dimmed = json::parse(read_file(folder / "out/dimmed/summary.json"));
  for (const char* what : {"mean_irradiance", "mean_irradiance_error", "relative_error_l2", "relative_noise_l2"})
    EXPECT_NEAR(dimmed.at(what).get<double>(), whole.at(what).get<double>(), 1e-9 * whole.at(what).get<double>())
        << what;
}

}  // namespace
}  // namespace interflect::test
