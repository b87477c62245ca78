#include "tests/montecarlo/statistics.h"

#include <gtest/gtest-spi.h>

#include "tests/support/shapes.h"

namespace interflect::test {
namespace {

TEST(Statistics, the_critical_z_is_that_of_sidak) {
  EXPECT_NEAR(critical_z(0.01, 100), 3.8894, 1e-4);
  EXPECT_NEAR(critical_z(0.01, 1000), 4.4161, 1e-4);
  EXPECT_NEAR(critical_z(0.05, 1), 1.95996, 1e-5);
}

// Alpha is divided among no more and no less than what is compared.
TEST(Statistics, a_family_is_as_large_as_it_was_told) {
  Family family(4, 4e-2);
  EXPECT_NEAR(family.z(), 2.3263, 1e-4);  // one tail of 1 %
  EXPECT_EQ(family.level(2), 1e-2);
  for (const std::size_t tails : {1, 3})
    EXPECT_NONFATAL_FAILURE(
        {
          Family other(2);
          other.level(tails);
        },
        "alpha was divided");
}

// The test's own test: a furnace whose truth is told 2 % wrong is found out.
TEST(Statistics, agreement_with_a_wrong_truth_is_not_found) {
  static scene::Scene scene;
  scene::SceneBuilder builder({"grey"});
  builder.add_box("room", {Vec3(0, 0, 0), Vec3(1, 1, 1)}, builder.add_material(diffuse("grey", 0.5, 0.5)),
                  scene::SceneBuilder::Facing::inward);
  scene = builder.finish();
  EXPECT_FATAL_FAILURE(
      {
        ::testing::TestPartResultArray results;
        {
          const ::testing::ScopedFakeTestPartResultReporter collect(
              ::testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &results);
          expect_agreement(scene, {whole(scene, "room/z-", 1.02)}, {.samples = 20'000}, 0.01);
        }
        if (results.size() == 1) GTEST_FATAL_FAILURE_("one failure, as it should be");
      },
      "as it should be");
}

}  // namespace
}  // namespace interflect::test
