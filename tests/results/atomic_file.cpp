#include "results/atomic_file.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "full_disk.h"
#include "results/output_directory.h"
#include "tests/support/temporary_folder.h"

using namespace interflect;
using namespace interflect::results;
using test::FullDisk;

namespace {

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const core::InputError& problem) {
    return problem.what();
  }
  return "";
}

}  // namespace

TEST(AtomicFile, what_is_written_is_read_and_nothing_else_is_left) {
  const test::TemporaryFolder scratch;
  const std::string bytes("a\0b\r\n\xff", 6);
  write_atomically(scratch / "file", bytes);
  EXPECT_EQ(test::read_file(scratch / "file"), bytes);
  write_atomically(scratch / "file", "new");
  EXPECT_EQ(test::read_file(scratch / "file"), "new");
  EXPECT_EQ(scratch.files(), 1u);
}

TEST(AtomicFile, a_full_disk_leaves_the_old_file_and_nothing_else) {
  const test::TemporaryFolder scratch;
  write_atomically(scratch / "file", "old");
  std::string message;
  {
    const FullDisk full(1000);
    message = message_of([&] { write_atomically(scratch / "file", std::string(100000, 'x')); });
  }
  EXPECT_EQ(message, (scratch / "file").string() + ": cannot be written: File too large");
  EXPECT_EQ(test::read_file(scratch / "file"), "old");
  EXPECT_EQ(scratch.files(), 1u);
}

TEST(AtomicFile, a_place_that_cannot_be_written_is_named_in_one_line) {
  const test::TemporaryFolder scratch;
  EXPECT_EQ(message_of([&] { write_atomically(scratch / "no/such/file", "x"); }),
            (scratch / "no/such/file").string() + ": cannot be written: No such file or directory");
  EXPECT_NE(message_of([&] { write_atomically(scratch.path(), "x"); }), "");
  EXPECT_EQ(scratch.files(), 0u);
}

TEST(AtomicFile, files_get_the_permissions_that_other_programs_give) {
  const test::TemporaryFolder scratch;
  write_atomically(scratch / "ours", "x");
  std::ofstream(scratch / "theirs") << "x";
  EXPECT_EQ(std::filesystem::status(scratch / "ours").permissions(),
            std::filesystem::status(scratch / "theirs").permissions());
}

TEST(OutputDirectory, is_made_with_its_parents_and_kept_with_what_is_in_it) {
  const test::TemporaryFolder scratch;
  {
    const OutputDirectory first(scratch / "a/b/c"), second(scratch / "a/b/c");
    EXPECT_TRUE(std::filesystem::is_empty(scratch / "a/b/c"));
    write_atomically(scratch / "a/b/file", "x");
  }
  EXPECT_TRUE(std::filesystem::exists(scratch / "a/b/file"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "a/b/c")) << "it is empty";
}

TEST(OutputDirectory, leaves_what_was_there_and_nothing_that_it_made_for_nothing) {
  const test::TemporaryFolder scratch;
  std::filesystem::create_directory(scratch / "ours");
  { const OutputDirectory directory(scratch / "ours"), inner(scratch / "ours/x/y/"); }
  EXPECT_TRUE(std::filesystem::is_empty(scratch / "ours"));
  EXPECT_EQ(scratch.files(), 1u);
}

TEST(OutputDirectory, that_cannot_be_used_is_refused_before_any_work) {
  const test::TemporaryFolder scratch;
  std::ofstream(scratch / "file") << "x";
  EXPECT_EQ(message_of([&] { OutputDirectory(scratch / "file"); }),
            (scratch / "file").string() + ": cannot be written: Not a directory");
  EXPECT_EQ(message_of([&] { OutputDirectory(scratch / "file/out"); }),
            (scratch / "file/out").string() + ": cannot be written: Not a directory");
  EXPECT_EQ(message_of([] { OutputDirectory("/proc/interflect"); }).rfind("/proc/interflect: cannot be written: ", 0),
            0u);
  const FullDisk full(0);
  EXPECT_EQ(message_of([&] { OutputDirectory(scratch / "full"); }),
            (scratch / "full").string() + ": cannot be written: File too large");
  EXPECT_EQ(scratch.files(), 1u);
}
