#include "core/memory.h"

#include <sys/resource.h>

namespace interflect::core {

double peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);  // told in kibibytes
}

}  // namespace interflect::core
