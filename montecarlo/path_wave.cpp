#include "montecarlo/path_wave.h"

namespace interflect::montecarlo {

void PathEstimator::irradiance(std::span<const Receiver> at, const Keys& keys, std::uint32_t block,
                               std::span<Spectrum> found) const {
  Wave<Unaccompanied> wave(*this, keys, at.size());
  for (std::size_t first = 0; first < at.size(); first += Wave<Unaccompanied>::most) {
    const std::size_t count = std::min(Wave<Unaccompanied>::most, at.size() - first);
    wave.begin(first, count);
    for (std::size_t k = 0; k < count; ++k) wave.start(k, receiving(at[first + k]));
    wave.follow(block);
    for (std::size_t k = 0; k < count; ++k) found[first + k] = wave.found(k) * pi;
  }
}

void PathEstimator::radiance(std::span<const std::optional<raycast::Ray>> from_eye, const Keys& keys,
                             std::uint32_t block, std::span<Spectrum> found) const {
  Wave<Unaccompanied> wave(*this, keys, from_eye.size());
  for (std::size_t first = 0; first < from_eye.size(); first += Wave<Unaccompanied>::most) {
    const std::size_t count = std::min(Wave<Unaccompanied>::most, from_eye.size() - first);
    wave.begin(first, count);
    wave.start(from_eye.subspan(first, count));
    wave.follow(block);
    for (std::size_t k = 0; k < count; ++k) found[first + k] = wave.found(k);
  }
}

}  // namespace interflect::montecarlo
