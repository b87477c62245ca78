#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace interflect::montecarlo {

/// Samples first .. end - 1 of one measurement, traced by one thread.
struct SampleBlock {
  std::uint32_t measurement;
  std::uint64_t first, end;
};

/// All samples of all measurements as blocks, in portions of bounded length, whose results are kept at once.
///
/// Blocks come round by round: the first of every measurement, the second of every measurement that has one, .. , so
/// that all measurements advance together.  A round longer than a wave is cut, and goes on in the next.
class Waves {
 public:
  static constexpr std::uint64_t samples_per_block = 256;
  static constexpr std::size_t blocks_per_wave = 8192;

  /// @param counts  samples of each measurement; must outlive this
  explicit Waves(std::span<const std::uint64_t> counts);

  /// At most `blocks_per_wave` blocks; none when all have been given.
  std::vector<SampleBlock> next();

 private:
  void end_round();

  std::span<const std::uint64_t> counts_;
  std::vector<std::uint32_t> left_;  ///< measurements that have a block in this round
  std::size_t position_ = 0;         ///< in `left_`
  std::uint64_t first_ = 0;          ///< sample of this round
};

}  // namespace interflect::montecarlo
