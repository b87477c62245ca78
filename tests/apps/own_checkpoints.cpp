#include <gtest/gtest.h>

#include <filesystem>

#include "tests/apps/program.h"

// Whose checkpoint lies beside a picture, and until when.
namespace interflect::test {
namespace {

namespace fs = std::filesystem;

/// A picture that may grow lies in the folder, with what it goes on from.
class OwnCheckpoints : public ::testing::Test {
 protected:
  void SetUp() override {
    const Outcome first = trace({"--spp", "1", "--keep-checkpoint"});
    ASSERT_EQ(first.status, 0) << first.err;
    ASSERT_TRUE(fs::exists(checkpoint_));
  }
  Outcome trace(const std::vector<std::string>& more, const Circumstances& how = {}) const {
    std::vector<std::string> all{"trace", shipped_scene("furnace"), "-o", folder_ / "p.exr"};
    all.insert(all.end(), more.begin(), more.end());
    return interflect(all, how);
  }
  /// A run that goes on, and has estimates to make when its pictures are there.
  Outcome with_estimates(const char* accuracy, const std::function<bool()>& when_drawn) const {
    fs::remove(folder_ / "p.png");
    return trace({"--spp", "2", "--resume", "--estimates", folder_ / "tables", "--accuracy", accuracy},
                 {.interrupt_when = [&](const std::string&) { return fs::exists(folder_ / "p.png") && when_drawn(); }});
  }

  TemporaryFolder folder_;
  fs::path checkpoint_ = folder_ / "p.checkpoint.h5";
};

// A look at the same picture in between: it neither wrote the checkpoint nor went on from it.
TEST_F(OwnCheckpoints, of_another_run_are_left_as_they_are) {
  const std::string before = read_file(checkpoint_);
  const Outcome look = trace({"--spp", "2"});
  EXPECT_EQ(look.status, 0) << look.err;
  EXPECT_FALSE(contains(look.out + look.err, "--resume goes on from")) << look.out << look.err;
  ASSERT_TRUE(fs::exists(checkpoint_));
  EXPECT_TRUE(read_file(checkpoint_) == before);
  const Outcome gone_on = trace({"--spp", "2", "--resume"});
  EXPECT_EQ(gone_on.status, 0) << gone_on.err;
  EXPECT_FALSE(fs::exists(checkpoint_));
}

TEST_F(OwnCheckpoints, stay_where_a_stop_comes_to_the_estimates) {
  const Outcome stopped = with_estimates("0.0001%", [] { return true; });
  EXPECT_EQ(stopped.status, 1) << stopped.err;
  EXPECT_TRUE(contains(stopped.out, "stopped before all was done")) << stopped.out;
  EXPECT_TRUE(contains(stopped.out, "--resume goes on from")) << stopped.out;
  EXPECT_TRUE(fs::exists(checkpoint_));
}

// A folder that has something in it is removed by nobody, whoever runs this test.
TEST_F(OwnCheckpoints, that_cannot_be_removed_are_warned_of) {
  bool in_the_way = false;
  const Outcome outcome = with_estimates("0.2%", [&] {
    if (in_the_way) return false;
    in_the_way = fs::remove(checkpoint_) && fs::create_directories(checkpoint_ / "something");
    return false;
  });
  ASSERT_TRUE(in_the_way) << "the estimates were made before anyone looked";
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "p.checkpoint.h5: the checkpoint is not removed")) << outcome.err;
  EXPECT_FALSE(contains(outcome.err, "internal error")) << outcome.err;
}

}  // namespace
}  // namespace interflect::test
