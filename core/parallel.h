#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/vec.h"

namespace interflect::core {

/// The threads of a run.  Work is cut into blocks by index alone, so that results do not depend on their number.
///
/// Two backends, picked by the build: oneTBB, and plain std::thread, on which ThreadSanitizer can see what happens.
class Threads {
 public:
  /// @param count  threads to use, the caller's included; 0 for all that the machine has
  explicit Threads(unsigned count = 0);
  ~Threads();
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  unsigned count() const { return count_; }

  /// body(begin, end) for [0, n) cut into blocks of `block`, in any order, on any thread.  The first exception is
  /// rethrown.
  void for_blocks(Index n, Index block, const std::function<void(Index begin, Index end)>& body) const;

 private:
  struct Backend;
  void run_tasks(Index tasks, const std::function<void(Index task)>& body) const;

  unsigned count_;
  std::unique_ptr<Backend> backend_;
};

/// sum of block(begin, end) over the blocks of [0, n), added in the order of the blocks: same bits for any number of
/// threads.
template <class T, class Block>
T reduce_in_blocks(const Threads& threads, Index n, Index block_size, T zero, const Block& block) {
  std::vector<T> partial(static_cast<std::size_t>((n + block_size - 1) / block_size), zero);
  threads.for_blocks(n, block_size, [&](Index begin, Index end) {
    partial[static_cast<std::size_t>(begin / block_size)] = block(begin, end);
  });
  for (const T& p : partial) zero += p;
  return zero;
}

}  // namespace interflect::core
