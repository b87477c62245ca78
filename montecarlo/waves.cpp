#include "montecarlo/waves.h"

#include <algorithm>

namespace interflect::montecarlo {

Waves::Waves(std::span<const std::uint64_t> counts) : counts_(counts) {
  for (std::uint32_t m = 0; m < counts.size(); ++m)
    if (counts[m] > 0) left_.push_back(m);
}

std::vector<SampleBlock> Waves::next() {
  std::vector<SampleBlock> wave;
  while (wave.size() < blocks_per_wave && !left_.empty()) {
    const std::uint32_t m = left_[position_];
    wave.push_back({m, first_, std::min(first_ + samples_per_block, counts_[m])});
    if (++position_ == left_.size()) end_round();
  }
  return wave;
}

void Waves::end_round() {
  position_ = 0;
  first_ += samples_per_block;
  std::erase_if(left_, [&](std::uint32_t m) { return counts_[m] <= first_; });
}

}  // namespace interflect::montecarlo
