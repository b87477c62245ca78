#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>
#include <thread>

#include "core/parallel.h"

namespace interflect::core {

struct Threads::Backend {
  explicit Backend(unsigned count) : arena(static_cast<int>(count)) {
    // More threads than processors: what a test of determinism wants.
    if (count > std::thread::hardware_concurrency()) limit.emplace(tbb::global_control::max_allowed_parallelism, count);
  }
  std::optional<tbb::global_control> limit;
  tbb::task_arena arena;
};

Threads::Threads(unsigned count)
    : count_(count != 0 ? count : std::max(1u, std::thread::hardware_concurrency())),
      backend_(std::make_unique<Backend>(count_)) {}

Threads::~Threads() = default;

void Threads::run_tasks(Index tasks, const std::function<void(Index)>& body) const {
  // A thread that waits for the rest of these tasks takes none of another loop's: it may hold what that one waits for.
  backend_->arena.execute([&] {
    tbb::this_task_arena::isolate([&] { tbb::parallel_for(Index{0}, tasks, body, tbb::simple_partitioner{}); });
  });
}

}  // namespace interflect::core
