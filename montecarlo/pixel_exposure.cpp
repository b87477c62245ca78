#include "montecarlo/pixel_exposure.h"

#include <algorithm>
#include <chrono>

#include "core/seconds_since.h"

namespace interflect::montecarlo {
namespace {

using Clock = std::chrono::steady_clock;

constexpr Index pixels_per_block = 256;
constexpr std::uint64_t first_pass = 4;  ///< samples a pixel
constexpr double wished_seconds = 2;     ///< of a portion

}  // namespace

void PixelExposure::Pace::took(std::uint64_t samples, double seconds) {
  const double wished = static_cast<double>(samples) * wished_seconds / std::max(seconds, 1e-6);
  portion_ = static_cast<std::uint64_t>(std::clamp(wished, 4096.0, 4 * static_cast<double>(portion_)));
}

std::uint64_t PixelExposure::pass(Film& film, std::uint64_t done, std::uint64_t limit, core::Progress::Stage& stage,
                                  const std::function<void()>& after_some) {
  const std::uint64_t least = std::max(first_pass, unit_);
  const std::uint64_t at_once = std::max(least, pace_.portion() / film.pixels()) / unit_ * unit_;
  const std::uint64_t end = std::min(limit, done + std::min(std::max(least, done), at_once));
  const std::uint64_t each = end - done;
  for (std::size_t begin = 0; begin < film.pixels() && !run_.stop.stop_requested();) {
    const std::size_t band = std::max<std::size_t>(pixels_per_block, pace_.portion() / each);
    const std::size_t past = std::min(film.pixels(), begin + band);
    const Clock::time_point start = Clock::now();
    run_.threads.for_blocks(static_cast<Index>(past - begin), pixels_per_block, [&](Index from, Index to) {
      if (run_.stop.stop_requested()) return;
      for (Index p = from; p < to; ++p) {
        const std::size_t pixel = begin + static_cast<std::size_t>(p);
        // Of a run that had come further here before it was stopped there is nothing left to do.
        if (film.samples(pixel) < end) expose(film, pixel, film.samples(pixel), end);
      }
      stage.advance(static_cast<std::uint64_t>(to - from) * each);
    });
    pace_.took((past - begin) * each, core::seconds_since(start));
    begin = past;
    after_some();
  }
  return end;
}

}  // namespace interflect::montecarlo
