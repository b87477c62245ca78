#include "visual/display.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "core/error.h"
#include "core/format.h"
#include "environment.h"
#include "visual/x_server.h"

using namespace interflect;
using namespace interflect::visual;
using test::Environment;

namespace {

/// Running, and not a zombie that somebody has yet to collect.
bool alive(pid_t process) {
  std::ifstream stat(core::format("/proc/%d/stat", process));
  std::string line;
  if (!std::getline(stat, line)) return false;
  const char state = line[line.rfind(')') + 2];
  return state != 'Z' && state != 'X';
}

template <class Condition>
bool happens_within(std::chrono::seconds patience, const Condition& condition) {
  for (const auto end = std::chrono::steady_clock::now() + patience; std::chrono::steady_clock::now() < end;
       std::this_thread::sleep_for(std::chrono::milliseconds(20)))
    if (condition()) return true;
  return condition();
}

bool gone_within(pid_t process, std::chrono::seconds patience) {
  return happens_within(patience, [=] { return !alive(process); });
}

/// Has the server taken its files with it?  Another program may use its number by now: then the lock names that one.
bool has_tidied_up(pid_t process, int number) {
  std::ifstream lock(core::format("/tmp/.X%d-lock", number));
  if (pid_t owner = 0; lock >> owner) return owner != process;
  return !std::filesystem::exists(core::format("/tmp/.X11-unix/X%d", number));
}

bool tidies_up_within(pid_t process, int number, std::chrono::seconds patience) {
  return happens_within(patience, [=] { return has_tidied_up(process, number); });
}

}  // namespace

TEST(Display, a_server_of_ours_ends_without_a_zombie_or_a_lock_file) {
  pid_t process = 0;
  int number = 0;
  {
    const XServer server;
    process = server.process();
    number = server.number();
    EXPECT_TRUE(alive(process));
    EXPECT_FALSE(has_tidied_up(process, number));
  }
  EXPECT_EQ(::kill(process, 0), -1);  // collected, not a zombie
  EXPECT_TRUE(tidies_up_within(process, number, std::chrono::seconds(20)));
}

TEST(Display, two_servers_get_along) {
  const XServer one, two;
  EXPECT_NE(one.number(), two.number());
}

TEST(Display, a_server_ends_with_a_program_that_is_killed) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t program = ::fork();
  if (program == 0) {
    const XServer server;
    const int told[] = {static_cast<int>(server.process()), server.number()};
    if (::write(ends[1], told, sizeof told) != sizeof told) ::_exit(1);
    ::kill(::getpid(), SIGKILL);
  }
  int told[2] = {0, 0};
  ASSERT_EQ(::read(ends[0], told, sizeof told), static_cast<ssize_t>(sizeof told));
  ::waitpid(program, nullptr, 0);
  EXPECT_TRUE(gone_within(told[0], std::chrono::seconds(20)));
  EXPECT_TRUE(tidies_up_within(told[0], told[1], std::chrono::seconds(20)));
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST(Display, an_interrupt_from_the_keyboard_reaches_the_program_alone) {
  const XServer server;
  EXPECT_NE(::getpgid(server.process()), ::getpgid(0));
}

TEST(Display, a_display_that_does_not_answer_is_replaced_and_put_back) {
  const Environment stale("DISPLAY", ":4711");
  {
    const visual::Display display;
    ASSERT_NE(display.own(), nullptr);
    EXPECT_EQ(std::getenv("DISPLAY"), core::format(":%d", display.own()->number()));
    const visual::Display second;  // the first one answers
    EXPECT_EQ(second.own(), nullptr);
  }
  EXPECT_STREQ(std::getenv("DISPLAY"), ":4711");
}

TEST(Display, without_the_package_one_line_names_it) {
  const Environment none("DISPLAY", nullptr), nowhere("PATH", "/nonexistent");
  try {
    const visual::Display display;
    ADD_FAILURE();
  } catch (const core::InputError& problem) {
    const std::string line = problem.what();
    EXPECT_NE(line.find("apt-get install xvfb"), std::string::npos);
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
  EXPECT_EQ(std::getenv("DISPLAY"), nullptr);
}
