#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <utility>

#include "montecarlo/bsdf/cosine_table.h"

namespace interflect::montecarlo {

/// Tables of functions that two numbers tell apart, each made once: those of a rough surface take a tenth of a second,
/// and all that is made of a scene, integrator by integrator and run by run, has the same.  What is kept depends on those
/// numbers alone, so that a run remains a function of its scene, settings and seed.
class KeptTables {
 public:
  using Numbers = std::pair<double, double>;

  CosineTable of(const Numbers& numbers, const std::function<double(double cosine)>& function) {
    const std::scoped_lock lock(making_);
    const auto kept = tables_.find(numbers);
    return kept != tables_.end() ? kept->second : tables_.emplace(numbers, CosineTable(function)).first->second;
  }

 private:
  std::mutex making_;
  std::map<Numbers, CosineTable> tables_;
};

}  // namespace interflect::montecarlo
