#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "core/parallel.h"

namespace interflect::core {

struct Threads::Backend {};  // threads are started for each loop: this backend is for checking, not for speed

Threads::Threads(unsigned count)
    : count_(count != 0 ? count : std::max(1u, std::thread::hardware_concurrency())),
      backend_(std::make_unique<Backend>()) {}

Threads::~Threads() = default;

void Threads::run_tasks(Index tasks, const std::function<void(Index)>& body) const {
  std::atomic<Index> next{0};
  std::exception_ptr first;
  std::mutex first_mutex;
  const auto work = [&] {
    for (Index t; (t = next.fetch_add(1)) < tasks;) try {
        body(t);
      } catch (...) {
        const std::scoped_lock lock(first_mutex);
        if (!first) first = std::current_exception();
        next = tasks;
      }
  };
  {
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < count_; ++i) others.emplace_back(work);
    work();
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace interflect::core
