#include "montecarlo/measurement_sampler.h"

#include <algorithm>

#include "montecarlo/measurable.h"

namespace interflect::montecarlo {

namespace {

// Dimensions: the place, or the film and the lens, own the first block or two; the path owns the rest, at once, so that
// of a sequence's groups of four one holds the place and the point of the light that is drawn for it.
constexpr std::uint32_t film_block = 0, lens_block = 1;
constexpr std::uint32_t second_path_block = 1u << 30;  // no path comes that far

std::uint32_t path_block(const scene::FilmMap& film) { return film.has_lens() ? lens_block + 1 : film_block + 1; }

/// Where a sample meets the film, and the lens.
struct OnFilm {
  double u, v;
  Vec2 lens = Vec2::Zero();
};
OnFilm on_film(const scene::FilmMap& film, core::RandomNumbers& numbers) {
  numbers.jump(film_block);
  const double u = numbers.next();
  OnFilm at{u, numbers.next()};
  if (film.has_lens()) {
    numbers.jump(lens_block);
    const double r = numbers.next();
    at.lens = scene::uniform_disk(r, numbers.next());
  }
  return at;
}
Vec2 middle_of(const PixelOnFilm& pixel) { return {pixel.x + 0.5, pixel.y + 0.5}; }

}  // namespace

Spectrum film_sample(const scene::FilmMap& film, const ReconstructionFilter& filter, const PixelOnFilm& pixel,
                     const PathEstimator& paths, core::RandomNumbers& numbers) {
  const OnFilm at = on_film(film, numbers);
  const auto radiance = [&](const Vec2& offset, std::uint32_t block) {
    const auto ray = film.ray(middle_of(pixel) + offset, at.lens);
    return ray ? paths.radiance(ray->origin, ray->direction, numbers, block) : Spectrum::zero();
  };
  const double negative = filter.negative();
  const Spectrum found = radiance(filter.sample(at.u, at.v), path_block(film));
  if (negative == 0) return found;
  return (1 + negative) * found - negative * radiance(filter.sample_negative(at.u, at.v), second_path_block);
}

void film_samples(const scene::FilmMap& film, const ReconstructionFilter& filter, const PixelOnFilm& pixel,
                  const PathEstimator& paths, const PathEstimator::Keys& keys, std::span<Spectrum> samples) {
  const auto radiances = [&](auto rays, std::uint32_t block, auto found) { paths.radiance(rays, keys, block, found); };
  film_samples(film, filter, pixel, radiances, keys, samples);
}

void film_samples(const scene::FilmMap& film, const ReconstructionFilter& filter, const PixelOnFilm& pixel,
                  const Radiances& radiances, const PathEstimator::Keys& keys, std::span<Spectrum> samples) {
  std::vector<OnFilm> at;
  at.reserve(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    core::RandomNumbers numbers = keys.numbers(k);
    at.push_back(on_film(film, numbers));
  }
  std::vector<Spectrum> found(samples.size());
  const auto seen = [&](auto offset, std::uint32_t block) {
    std::vector<std::optional<raycast::Ray>> rays;
    rays.reserve(samples.size());
    for (const OnFilm& each : at) {
      const auto ray = film.ray(middle_of(pixel) + offset(each), each.lens);
      rays.push_back(ray ? std::optional(raycast::Ray{ray->origin, ray->direction}) : std::nullopt);
    }
    radiances(rays, block, found);
  };
  seen([&](const OnFilm& each) { return filter.sample(each.u, each.v); }, path_block(film));
  std::copy(found.begin(), found.end(), samples.begin());
  const double negative = filter.negative();
  if (negative == 0) return;
  seen([&](const OnFilm& each) { return filter.sample_negative(each.u, each.v); }, second_path_block);
  for (std::size_t k = 0; k < samples.size(); ++k) samples[k] = (1 + negative) * samples[k] - negative * found[k];
}

MeasurementSampler::MeasurementSampler(const scene::Scene& scene, const measure::Measurement& asked)
    : scale_(scale_of(asked)) {
  require_measurable(scene, asked);
  if (const auto* pixel = std::get_if<measure::PixelRadiance>(&asked)) {
    film_ = std::make_shared<const scene::FilmMap>(scene.camera(pixel->camera));
    pixel_ = {pixel->x, pixel->y};
  } else {
    place_.emplace(asked);
  }
}

std::optional<raycast::Ray> MeasurementSampler::ray(core::RandomNumbers& numbers) const {
  const OnFilm at = on_film(*film_, numbers);
  const auto seen = film_->ray(middle_of(pixel_) + box_filter().sample(at.u, at.v), at.lens);
  return seen ? std::optional(raycast::Ray{seen->origin, seen->direction}) : std::nullopt;
}

Spectrum MeasurementSampler::sample(const PathEstimator& paths, core::RandomNumbers& numbers) const {
  if (film_) return film_sample(*film_, box_filter(), pixel_, paths, numbers);
  const Receiver at = place_->draw(numbers);
  return scale_ * paths.irradiance(at, numbers, place_->blocks());
}

void MeasurementSampler::sample(const PathEstimator& paths, const PathEstimator::Keys& keys,
                                std::span<Spectrum> samples) const {
  if (film_) {
    film_samples(*film_, box_filter(), pixel_, paths, keys, samples);
    return;
  }
  std::vector<Receiver> at;
  at.reserve(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    core::RandomNumbers numbers = keys.numbers(k);
    at.push_back(place_->draw(numbers));
  }
  paths.irradiance(at, keys, place_->blocks(), samples);
  for (Spectrum& each : samples) each = scale_ * each;
}

}  // namespace interflect::montecarlo
