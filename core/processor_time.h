#pragma once

#include <ctime>

namespace interflect::core {

/// Adds to a number the processor time of all threads of the program [s] while it lives.
class ProcessorTime {
 public:
  explicit ProcessorTime(double& seconds) : seconds_(seconds) {}
  ~ProcessorTime() { seconds_ += static_cast<double>(std::clock() - begin_) / CLOCKS_PER_SEC; }
  ProcessorTime(const ProcessorTime&) = delete;
  ProcessorTime& operator=(const ProcessorTime&) = delete;

 private:
  double& seconds_;
  std::clock_t begin_ = std::clock();
};

}  // namespace interflect::core
