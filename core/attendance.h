#pragma once

#include <algorithm>

namespace interflect::core {

/// How many of a team (`Team`) work that is done again and again is for, where any number of them gives the same: all, until
/// one waited for others a good part of the time, as processors have other work too; then one alone, and all once more
/// after a while, which gets longer as long as they have to wait.
class Attendance {
 public:
  explicit Attendance(unsigned all) : all_(all) {}

  unsigned members() const { return times_alone_ > 0 ? 1 : all_; }

  /// The work was done once.
  /// @param seconds  that it took
  /// @param waited   of those, the most that a member waited
  void add(double seconds, double waited) {
    constexpr double good_part = 0.25;
    if (times_alone_ > 0) {
      --times_alone_;
    } else if (waited > good_part * seconds) {
      times_alone_ = next_times_;
      next_times_ = std::min(2 * next_times_, most_times);
    } else {
      next_times_ = first_times;
    }
  }

 private:
  static constexpr int first_times = 2, most_times = 64;
  unsigned all_;
  int times_alone_ = 0, next_times_ = first_times;
};

}  // namespace interflect::core
