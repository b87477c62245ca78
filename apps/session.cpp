#include "apps/session.h"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
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

/// A thread that waits for the signals, and for the end of a time: no code runs inside a signal handler.
class Session::SignalWatch {
 public:
  /// @param seconds  0: for ever
  /// @param late     asked to stop too, and before, where it is the time that is over
  SignalWatch(std::stop_source& stop, std::stop_source& late, double seconds)
      : thread_([this, &stop, &late, seconds] { watch(stop, late, seconds); }) {}
  ~SignalWatch() {
    done_ = true;
    pthread_kill(thread_.native_handle(),
                 SIGTERM);  // NOLINT(bugprone-bad-signal-to-kill-thread): it waits for that one in sigwait
    thread_.join();
  }

 private:
  void watch(std::stop_source& stop, std::stop_source& late, double seconds) {
    const sigset_t set = watched_signals();
    if (seconds > 0) {
      const bool signalled = came_within(seconds, set);
      if (done_) return;
      if (!signalled) late.request_stop();
      stop.request_stop();
      core::log::warning(signalled ? "stopping; once more to end at once" : "--max-time is over: stopping");
    }
    for (int signal = 0; sigwait(&set, &signal) == 0 && !done_;) {
      if (!stop.request_stop()) _exit(exit_on_second_interrupt);
      core::log::warning("stopping; once more to end at once");
    }
  }
  /// Whether a signal came in time.
  static bool came_within(double seconds, const sigset_t& set) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    for (;;) {
      const double left = std::chrono::duration<double>(end - std::chrono::steady_clock::now()).count();
      if (!(left > 0)) return false;
      const double whole = std::min(std::floor(left), 1e9);
      const timespec wait{static_cast<time_t>(whole), static_cast<long>(1e9 * std::min(left - whole, 0.999))};
      if (sigtimedwait(&set, nullptr, &wait) > 0) return true;
    }
  }

  std::atomic<bool> done_{false};
  std::thread thread_;
};

Session::Session(const CommonOptions& options)
    : threads_(options.threads),
      progress_(style(options)),
      run_{options.seed, threads_, progress_, stop_.get_token(), late_.get_token()},
      watch_(std::make_unique<SignalWatch>(stop_, late_, options.max_time)) {}

Session::~Session() = default;

}  // namespace interflect::apps
