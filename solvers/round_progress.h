#pragma once

#include <algorithm>
#include <mutex>

#include "core/progress.h"

namespace interflect::solvers {

/// Tells a person how far rounds have come, each of which doubles the samples: of all where their number is given, or of
/// those that the noise so far says its goal takes, since noise² falls as 1 / samples.
class RoundProgress {
 public:
  explicit RoundProgress(core::Progress& progress) : stage_(progress, "samples", parts) {}

  /// So many will be taken in all.
  void expect(double samples) {
    const std::scoped_lock lock(mutex_);
    expected_ = samples;
  }
  /// As many as rounds will have when they end, of which the last one has left this noise.
  void expect_by(double noise, double goal) {
    const double needed = done_ * (noise / goal) * (noise / goal);
    double all = done_;
    while (all < needed) all *= 2;
    expect(all);
  }
  /// So many more; from any thread.
  void add(double samples) {
    const std::scoped_lock lock(mutex_);
    done_ += samples;
    if (!(expected_ > 0)) return;
    const auto now = static_cast<std::uint64_t>(std::min(1.0, done_ / expected_) * parts);
    if (now <= told_) return;
    stage_.advance(now - told_);
    told_ = now;
  }

 private:
  static constexpr std::uint64_t parts = 1000;
  core::Progress::Stage stage_;
  std::mutex mutex_;
  double done_ = 0, expected_ = 0;
  std::uint64_t told_ = 0;
};

}  // namespace interflect::solvers
