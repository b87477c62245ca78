#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace interflect::core {

/// Tells a person how far a run has come, on standard error: a bar with the time to completion on a terminal, a line
/// after two seconds and then every ten elsewhere, nothing when quiet.  Stages shorter than two seconds stay silent.
class Progress {
 public:
  enum class Style { quiet, bar, lines };
  /// A bar on a terminal, lines elsewhere.
  static Style style_of_standard_error();

  explicit Progress(Style style = Style::quiet) : style_(style) {}
  /// Of a part of the work that `whole` tells of: its name, "path: pixels", stands before those of its stages.
  Progress(const Progress& whole, const std::string& part)
      : style_(whole.style_), expected_end_(whole.expected_end_), part_(whole.part_ + part + ", ") {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// How long all stages from now on will take together [s], as far as is known: what is left is counted from that too.
  void expect(double seconds) {
    expected_end_ = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                                           std::chrono::duration<double>(seconds));
  }

  /// One stage of work; ends with its scope.  `advance` may be called by any thread.
  class Stage {
   public:
    Stage(Progress& progress, const std::string& name, std::uint64_t total);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
    void advance(std::uint64_t units = 1);

   private:
    friend class Progress;
    using Clock = std::chrono::steady_clock;
    Progress& progress_;
    std::string name_;
    std::uint64_t total_;
    std::atomic<std::uint64_t> done_{0};
    Clock::time_point start_ = Clock::now();
    std::atomic<Clock::rep> next_report_;  ///< since the epoch of the clock: one thread wins the right to print
    bool shown_ = false;
  };

 private:
  void report(Stage& stage, std::uint64_t done);

  Style style_;
  std::chrono::steady_clock::time_point expected_end_{};  ///< set before stages begin
  std::mutex printing_;
  std::string part_;  ///< before the names of stages
};

}  // namespace interflect::core
