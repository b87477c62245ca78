#pragma once

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

#include "core/vec.h"

namespace interflect::core {

/// A count that one thread raises and others wait for, a microsecond or so where each has a processor: they look again and
/// again, and then let others run in between.  Where processors have other work too, that is milliseconds.
class alignas(64) StepCount {
 public:
  /// What was done before is seen by those who have waited.
  void raise_to(Index steps) { steps_.store(steps, std::memory_order_release); }
  /// The seconds that it took, less the first moment, ten microseconds or so.
  double wait_for(Index steps) const;

 private:
  std::atomic<Index> steps_{0};
};

/// Threads that work side by side and may wait for each other: what `Threads` does not promise, whose blocks may all run
/// on one.  They sleep between one work and the next.
class Team {
 public:
  /// @param members  1 or more, the caller included; fewer if the system has no threads left
  explicit Team(unsigned members);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  unsigned size() const { return static_cast<unsigned>(others_.size()) + 1; }

  /// body(member) of all members at once, 0 by the caller, until all have come to its end.  It may not throw: others
  /// could wait for what then never comes.
  void work(const std::function<void(unsigned member)>& body);

 private:
  void serve(unsigned member);
  void dismiss();

  const std::function<void(unsigned)>* body_ = nullptr;  ///< null: no work any more
  std::atomic<Index> called_{0};                         ///< to work, so many times
  std::atomic<unsigned> busy_{0};
  std::vector<std::thread> others_;
};

}  // namespace interflect::core
