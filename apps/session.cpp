#include "apps/session.h"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "core/log.h"

namespace interflect::apps {
namespace {

constexpr int exit_on_second_interrupt = 130;

sigset_t watched_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

core::Progress::Style style(const CommonOptions& options) {
  return options.quiet ? core::Progress::Style::quiet : core::Progress::style_of_standard_error();
}

}  // namespace

void block_watched_signals() {
  const sigset_t set = watched_signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

/// A thread that waits for the signals: no code runs inside a signal handler.
class Session::SignalWatch {
 public:
  explicit SignalWatch(std::stop_source& stop) : thread_([this, &stop] { watch(stop); }) {}
  ~SignalWatch() {
    done_ = true;
    pthread_kill(thread_.native_handle(),
                 SIGTERM);  // NOLINT(bugprone-bad-signal-to-kill-thread): it waits for that one in sigwait
    thread_.join();
  }

 private:
  void watch(std::stop_source& stop) {
    const sigset_t set = watched_signals();
    for (int signal = 0; sigwait(&set, &signal) == 0 && !done_;) {
      if (!stop.request_stop()) _exit(exit_on_second_interrupt);
      core::log::warning("stopping; once more to end at once");
    }
  }

  std::atomic<bool> done_{false};
  std::thread thread_;
};

Session::Session(const CommonOptions& options)
    : threads_(options.threads),
      progress_(style(options)),
      run_{options.seed, threads_, progress_, stop_.get_token()},
      watch_(std::make_unique<SignalWatch>(stop_)) {}

Session::~Session() = default;

}  // namespace interflect::apps
