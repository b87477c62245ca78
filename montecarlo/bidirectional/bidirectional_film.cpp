#include "montecarlo/bidirectional/bidirectional_film.h"

#include "montecarlo/film/spread.h"

namespace interflect::montecarlo {
namespace {

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

void BidirectionalFilm::sweep(std::uint64_t k, std::size_t begin, std::size_t end, std::span<Spectrum> samples,
                              Deposits& deposits) const {
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

void BidirectionalFilm::deposit(const BidirectionalEstimator::Splat& splat, Deposits& deposits) const {
  spread(splat.film, width_, height_, filter_, [&](int x, int y, double h) {
    const std::uint32_t pixel = index_of_[static_cast<std::size_t>(y * width_ + x)];
    if (pixel != none) deposits.emplace_back(pixel, splat.value * (h / static_cast<double>(pixels_.size())));
  });
}

}  // namespace interflect::montecarlo
