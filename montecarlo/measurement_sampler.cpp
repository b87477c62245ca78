#include "montecarlo/measurement_sampler.h"

#include "montecarlo/measurable.h"

namespace interflect::montecarlo {

namespace {

// Dimensions: the place, or the film and the lens, own the first two blocks; the path owns the rest.
constexpr std::uint32_t film_block = 0, lens_block = 1, path_block = 2;
constexpr std::uint32_t second_path_block = 1u << 30;  // no path comes that far

const ReconstructionFilter& box() {
  static const std::unique_ptr<ReconstructionFilter> filter = make_filter("box");
  return *filter;
}

}  // namespace

Spectrum film_sample(const scene::FilmMap& film, const ReconstructionFilter& filter, const PixelOnFilm& pixel,
                     const PathEstimator& paths, core::RandomNumbers& numbers) {
  numbers.jump(film_block);
  const double u = numbers.next(), v = numbers.next();
  Vec2 lens = Vec2::Zero();
  if (film.has_lens()) {
    numbers.jump(lens_block);
    const double r = numbers.next();
    lens = scene::uniform_disk(r, numbers.next());
  }
  const auto radiance = [&](const Vec2& offset, std::uint32_t block) {
    const auto ray = film.ray(Vec2(pixel.x + 0.5, pixel.y + 0.5) + offset, lens);
    return ray ? paths.radiance(ray->origin, ray->direction, numbers, block) : Spectrum::zero();
  };
  const double negative = filter.negative();
  const Spectrum found = radiance(filter.sample(u, v), path_block);
  if (negative == 0) return found;
  return (1 + negative) * found - negative * radiance(filter.sample_negative(u, v), second_path_block);
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

Spectrum MeasurementSampler::sample(const PathEstimator& paths, core::RandomNumbers& numbers) const {
  if (film_) return film_sample(*film_, box(), pixel_, paths, numbers);
  const Receiver at = place_->draw(numbers);
  return scale_ * paths.irradiance(at, numbers, path_block);
}

}  // namespace interflect::montecarlo
