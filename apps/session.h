#pragma once

#include <memory>

#include "apps/options.h"
#include "core/run.h"

namespace interflect::apps {

/// The threads, progress and Ctrl-C of one command.
///
/// The first Ctrl-C (or SIGTERM) asks the run to stop, so that it keeps what it has; the second ends the program at
/// once.
class Session {
 public:
  explicit Session(const CommonOptions& options);
  ~Session();

  Run& run() { return run_; }
  bool stopped() const { return stop_.stop_requested(); }

 private:
  class SignalWatch;

  core::Threads threads_;
  core::Progress progress_;
  std::stop_source stop_, late_;
  Run run_;
  std::unique_ptr<SignalWatch> watch_;
};

/// Blocks the signals that a Session watches, in this thread and all that it will start: to be called before any thread
/// exists.
void block_watched_signals();

}  // namespace interflect::apps
