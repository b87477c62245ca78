#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "core/memory.h"
#include "core/seconds_since.h"
#include "fem/radiosity.h"

namespace interflect::fem {

/// Notes what stages of a solve cost.
class StageClock {
 public:
  explicit StageClock(std::vector<StageCost>& stages) : stages_(stages) {}
  template <class Work>
  auto operator()(const std::string& stage, const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    struct Record {
      ~Record() { stages.push_back({name, core::seconds_since(begin), core::peak_memory_bytes()}); }
      std::vector<StageCost>& stages;
      const std::string& name;
      std::chrono::steady_clock::time_point begin;
    } const record{stages_, stage, start};
    return work();
  }

 private:
  std::vector<StageCost>& stages_;
};

}  // namespace interflect::fem
