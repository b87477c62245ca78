#include <gtest/gtest.h>

#include <sstream>

#include "tests/apps/program.h"

namespace interflect::test {
namespace {

TEST(Program, says_what_it_is) {
  const Outcome version = interflect({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_TRUE(contains(version.out, "interflect 0.1.0"));
}

TEST(Program, each_command_has_help_with_an_example) {
  for (const char* command :
       {"solve", "validate", "render", "trace", "compare", "view-factors", "compare-form-factors", "solvers",
        "integrators", "compare-solvers", "shoot", "dim", "exchange", "info", "check"}) {
    const Outcome help = interflect({command, "--help"});
    EXPECT_EQ(help.status, 0) << command;
    EXPECT_TRUE(contains(help.out, "Example:\n  interflect " + std::string(command))) << help.out;
    EXPECT_FALSE(contains(help.out, "{false}")) << help.out;
    ASSERT_TRUE(contains(help.out, "Options of every command:")) << help.out;
    for (const char* option : {"--seed", "--threads", "--max-time", "--json", "-q,--quiet", "-v,--verbose"})
      EXPECT_TRUE(contains(help.out.substr(help.out.find("Options of every command:")), option)) << help.out;
  }
}

/// The words of the example in a command's help, its scene and its results where the test has them.
std::vector<std::string> example_of(const std::string& help, const std::string& command,
                                    const TemporaryFolder& folder) {
  const std::size_t begin = help.find("Example:\n  interflect " + command);
  std::istringstream words(help.substr(help.find(command, begin)));
  std::vector<std::string> arguments;
  std::string line;
  std::getline(words, line);
  std::istringstream in_line(line);
  for (std::string word; in_line >> word;) {
    if (word.rfind("data/", 0) == 0) word = INTERFLECT_SOURCE_DIR "/" + word;
    if (!arguments.empty() && arguments.back() == "-o") word = folder / word;
    arguments.push_back(word);
  }
  return arguments;
}

// Stopped after a second where it takes longer: what is no command line, or has no such scene, ends with 2.
TEST(Program, examples_in_help_are_command_lines) {
  for (const char* command : {"solve", "validate", "render", "trace", "compare", "view-factors", "compare-form-factors",
                              "solvers", "integrators", "compare-solvers", "shoot", "exchange", "info", "check"}) {
    const TemporaryFolder folder;
    std::vector<std::string> example = example_of(interflect({command, "--help"}).out, command, folder);
    for (const char* more : {"--max-time", "1s"}) example.emplace_back(more);
    const Outcome outcome = interflect(example);
    EXPECT_TRUE(outcome.status == 0 || outcome.status == 1) << command << ": " << outcome.status << outcome.err;
    EXPECT_FALSE(contains(outcome.err, "internal error")) << outcome.err;
  }
}

TEST(Program, output_that_does_not_arrive_is_no_success) {
  for (const char* option : {"--json", "--quiet"}) {
    const Outcome full = interflect({"info", shipped_scene("furnace"), option}, {.prints_to = "/dev/full"});
    EXPECT_EQ(full.status, 2);
    EXPECT_EQ(full.err, "interflect: standard output cannot be written\n");
  }
}

}  // namespace
}  // namespace interflect::test
