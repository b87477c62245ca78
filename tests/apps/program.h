#pragma once

#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace interflect::test {

/// What a run of the program ended with.
struct Outcome {
  int status;  ///< exit status, or 128 + the signal that ended it
  std::string out, err;
};

/// What happens to the program while it runs.
struct Circumstances {
  long memory_limit_kb = 0;        ///< address space that it may have; 0: no limit
  double interrupt_after_s = 0;    ///< Ctrl-C comes then; 0: never
};

/// Runs `interflect ARGUMENTS`.
Outcome interflect(const std::vector<std::string>& arguments, const Circumstances& circumstances = {});

}  // namespace interflect::test
