#include "tests/apps/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <thread>

extern char** environ;

namespace interflect::test {

namespace {

/// The words of a command, through a shell only where a limit must be set.
std::vector<std::string> command_of(const std::vector<std::string>& arguments, long memory_limit_kb) {
  std::vector<std::string> words;
  if (memory_limit_kb > 0)
    words = {"/bin/sh", "-c", "ulimit -v " + std::to_string(memory_limit_kb) + "; exec \"$@\"", "sh"};
  words.emplace_back(INTERFLECT_PROGRAM);
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

pid_t start(std::vector<std::string> words, const std::string& out, const std::string& err) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT, 0600);
  pid_t pid = 0;
  const int failed = posix_spawn(&pid, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::runtime_error("cannot start " + words[0]);
  return pid;
}

/// Waits for the program, interrupts it when its time has come, kills it when it takes too long.
int status_of(pid_t pid, const std::string& err, const Circumstances& circumstances) {
  using namespace std::chrono;
  const auto end = steady_clock::now() + duration<double>(circumstances.patience_s);
  bool to_interrupt = static_cast<bool>(circumstances.interrupt_when), killed = false;
  for (int status = 0;;) {
    if (waitpid(pid, &status, WNOHANG) == pid) return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (to_interrupt && circumstances.interrupt_when(read_file(err))) {
      kill(pid, SIGINT);
      to_interrupt = false;
    }
    if (!killed && steady_clock::now() > end) {
      ADD_FAILURE() << "killed after " << circumstances.patience_s << " s";
      kill(pid, SIGKILL);
      killed = true;
    }
    std::this_thread::sleep_for(milliseconds(10));
  }
}

}  // namespace

Outcome interflect(const std::vector<std::string>& arguments, const Circumstances& circumstances) {
  const TemporaryFolder folder;
  const std::string err = folder / "err";
  const std::string out = circumstances.prints_to.empty() ? std::string(folder / "out") : circumstances.prints_to;
  const pid_t pid = start(command_of(arguments, circumstances.memory_limit_kb), out, err);
  const int status = status_of(pid, err, circumstances);
  return {status, circumstances.prints_to.empty() ? read_file(out) : "", read_file(err)};
}

}  // namespace interflect::test
