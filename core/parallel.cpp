#include "core/parallel.h"

#include <algorithm>

#include "core/error.h"

namespace interflect::core {

void Threads::for_blocks(Index n, Index block, const std::function<void(Index, Index)>& body) const {
  if (n < 0 || block <= 0) throw PreconditionError("for_blocks: n >= 0 and block > 0 expected");
  const Index tasks = (n + block - 1) / block;
  const auto task = [&](Index t) { body(t * block, std::min(n, (t + 1) * block)); };
  if (count_ == 1 || tasks <= 1)
    for (Index t = 0; t < tasks; ++t) task(t);
  else
    run_tasks(tasks, task);
}

}  // namespace interflect::core
