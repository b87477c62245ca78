#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace interflect::test {

/// What a run of the program ended with.
struct Outcome {
  int status;  ///< exit status, or 128 + the signal that ended it
  std::string out, err;
};

/// Sanitizers slow the program down, as they do the tests (cmake/InterflectTest.cmake).
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double usual_patience_s = 8 * 300;
#else
constexpr double usual_patience_s = 300;
#endif

/// What happens to the program while it runs.
struct Circumstances {
  long memory_limit_kb = 0;    ///< address space that it may have; 0: no limit
  std::string prints_to = {};  ///< a file in place of its standard output, such as /dev/full
  /// Ctrl-C comes as soon as this holds of what it has printed on standard error so far; empty: never.
  std::function<bool(const std::string& err)> interrupt_when = {};
  double patience_s = usual_patience_s;  ///< it is killed after that, and the test fails
};

/// Runs `interflect ARGUMENTS`.
Outcome interflect(const std::vector<std::string>& arguments, const Circumstances& circumstances = {});

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace interflect::test
