#include "montecarlo/bidirectional/bidirectional_film.h"

#include <algorithm>

#include "montecarlo/film/spread.h"

namespace interflect::montecarlo {
namespace {

constexpr std::size_t pixels_per_block = 256;
constexpr std::uint64_t samples_at_once = 1 << 13;
/// Of the eye's walk: film, lens, then its vertices; of a filter's second point.
constexpr std::uint32_t film_block = 0, lens_block = 1, walk_block = 2, second_walk_block = 1u << 30;

}  // namespace

BidirectionalFilm::BidirectionalFilm(const BidirectionalEstimator& walks, const scene::Camera& camera,
                                     std::vector<std::uint32_t> pixels, const ReconstructionFilter& filter,
                                     std::uint64_t seed)
    : walks_(walks),
      map_(camera),
      width_(camera.width),
      height_(camera.height),
      pixels_(std::move(pixels)),
      index_of_(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height), none),
      filter_(filter),
      seed_(seed) {
  for (std::uint32_t p = 0; p < pixels_.size(); ++p) index_of_[pixels_[p]] = p;
}

std::uint64_t BidirectionalFilm::sweeps_at_once() const {
  return std::max<std::uint64_t>(1, samples_at_once / std::max<std::size_t>(1, pixels_.size()));
}

std::vector<Spectrum> BidirectionalFilm::samples(std::uint64_t first, std::uint64_t end, Run& run) const {
  const std::size_t count = pixels_.size(), blocks = (count + pixels_per_block - 1) / pixels_per_block;
  const std::size_t tasks = static_cast<std::size_t>(end - first) * blocks;
  std::vector<Spectrum> samples(static_cast<std::size_t>(end - first) * count);
  std::vector<std::vector<Deposit>> deposits(tasks);
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

void BidirectionalFilm::sweep(std::uint64_t k, std::size_t begin, std::size_t end, std::span<Spectrum> samples,
                              std::vector<Deposit>& deposits) const {
  LightWalk light;
  std::vector<BidirectionalEstimator::Splat> splats;
  for (std::size_t p = begin; p < end; ++p) {
    core::RandomNumbers numbers(seed_, pixels_[p], k);
    walks_.walk_from_light(numbers, light);
    numbers.jump(lens_block);
    const double r = numbers.next(), turn = numbers.next();
    const BidirectionalEstimator::Camera camera{map_, scene::uniform_disk(r, turn),
                                                static_cast<double>(pixels_.size())};
    splats.clear();
    walks_.splat(camera, light, splats);
    for (const auto& each : splats) deposit(each, deposits);

    numbers.jump(film_block);
    const double u = numbers.next(), v = numbers.next(), negative = filter_.negative();
    const Vec2 middle(pixels_[p] % static_cast<std::uint32_t>(width_) + 0.5,
                      pixels_[p] / static_cast<std::uint32_t>(width_) + 0.5);
    const auto seen = [&](const Vec2& film, std::uint32_t block) {
      const auto ray = map_.ray(film, camera.lens);
      return ray ? walks_.radiance(camera, *ray, light, numbers, block) : Spectrum::zero();
    };
    samples[p] += (1 + negative) * seen(middle + filter_.sample(u, v), walk_block);
    if (negative > 0) samples[p] -= negative * seen(middle + filter_.sample_negative(u, v), second_walk_block);
  }
}

void BidirectionalFilm::deposit(const BidirectionalEstimator::Splat& splat, std::vector<Deposit>& deposits) const {
  spread(splat.film, width_, height_, filter_, [&](int x, int y, double h) {
    const std::uint32_t pixel = index_of_[static_cast<std::size_t>(y * width_ + x)];
    if (pixel != none) deposits.push_back({pixel, splat.value * (h / static_cast<double>(pixels_.size()))});
  });
}

}  // namespace interflect::montecarlo
