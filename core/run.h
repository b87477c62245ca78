#pragma once

#include <cstdint>
#include <stop_token>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"

namespace interflect {

/// What every long computation is given.  A result is a function of (scene, settings, seed) and of nothing else in
/// here.
struct Run {
  std::uint64_t seed;
  const core::Threads& threads;
  core::Progress& progress;
  std::stop_token stop;    ///< Ctrl-C, or time that is over: polled between units of work
  std::stop_token late{};  ///< time that is over alone, before `stop` says so: for who says why it stopped

  /// Throws core::Interrupted if the run was asked to stop: for stages that leave nothing worth keeping.
  void throw_if_stopped(const std::string& stage) const {
    if (stop.stop_requested()) throw core::Interrupted(stage);
  }
  /// Whether it was asked to stop because its time is over.
  bool out_of_time() const { return late.stop_requested(); }
  /// The same, deaf to that: for the last steps, which make what there is worth keeping.
  Run to_the_end() const { return {seed, threads, progress, {}}; }
};

namespace core {

/// A Run with its own threads and no progress shown: for tests, benchmarks and programs that need no more.
class LocalRun {
 public:
  explicit LocalRun(std::uint64_t seed = 1, unsigned threads = 0)
      : threads_(threads), run_{seed, threads_, progress_, {}} {}
  operator Run&() { return run_; }  // NOLINT(google-explicit-constructor): it stands for the run that it holds
  Run& get() { return run_; }

 private:
  Threads threads_;
  Progress progress_;
  Run run_;
};

}  // namespace core
}  // namespace interflect
