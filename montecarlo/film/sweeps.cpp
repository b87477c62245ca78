#include "montecarlo/film/sweeps.h"

#include <algorithm>

namespace interflect::montecarlo {
namespace {

constexpr std::size_t pixels_per_block = 256;
constexpr std::uint64_t samples_at_once = 1 << 13;

}  // namespace

std::uint64_t Sweeps::at_once() const {
  return std::max<std::uint64_t>(1, samples_at_once / std::max<std::size_t>(1, pixels()));
}

std::vector<Spectrum> Sweeps::samples(std::uint64_t first, std::uint64_t end, Run& run) const {
  const std::size_t count = pixels(), blocks = (count + pixels_per_block - 1) / pixels_per_block;
  const std::size_t tasks = static_cast<std::size_t>(end - first) * blocks;
  std::vector<Spectrum> samples(static_cast<std::size_t>(end - first) * count);
  std::vector<Deposits> deposits(tasks);
  run.threads.for_blocks(static_cast<Index>(tasks), 1, [&](Index task, Index) {
    if (run.stop.stop_requested()) return;
    const auto t = static_cast<std::size_t>(task), k = t / blocks, begin = t % blocks * pixels_per_block;
    sweep(first + k, begin, std::min(count, begin + pixels_per_block), std::span(samples).subspan(k * count, count),
          deposits[t]);
  });
  if (run.stop.stop_requested()) return {};
  for (std::size_t t = 0; t < tasks; ++t)
    for (const auto& [pixel, value] : deposits[t]) samples[t / blocks * count + pixel] += value;
  return samples;
}

}  // namespace interflect::montecarlo
