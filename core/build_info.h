#pragma once

#include <string>

namespace interflect::core {

/// What this library was built as: enough to repeat a run, printed by `--version` and written into every record.
struct BuildInfo {
  std::string version;   ///< "0.1.0"
  std::string compiler;  ///< "GNU 12.2.0, Release, tbb threads"
  int spectrum_capacity;
};

BuildInfo build_info();

/// Empty, or a sentence that says why this processor cannot run the instructions that the build was made for.
std::string unsupported_processor();

}  // namespace interflect::core
