#include "montecarlo/measurement_sampler.h"

#include "core/overloaded.h"
#include "montecarlo/measurable.h"
#include "montecarlo/warp.h"

namespace interflect::montecarlo {

namespace {

// Dimensions: the place owns the first two blocks, whatever kind it is; the path owns the rest.
constexpr std::uint32_t place_block = 0, pick_block = 1, lens_block = 1, path_block = 2;
constexpr std::uint32_t second_path_block = 1u << 30;  // no path comes that far

const ReconstructionFilter& box() {
  static const std::unique_ptr<ReconstructionFilter> filter = make_filter("box");
  return *filter;
}

}  // namespace

Spectrum film_sample(const scene::FilmMap& film, const ReconstructionFilter& filter, const PixelOnFilm& pixel,
                     const PathEstimator& paths, core::RandomNumbers& numbers) {
  numbers.jump(place_block);
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
  std::visit(core::Overloaded{[&](const measure::PatchIrradiance& m) {
                                set_regions({&m.patch, 1});
                              },
                              [&](const measure::Flux& m) { set_regions(m.through); },
                              [&](const measure::PointIrradiance& m) {
                                kind_ = Kind::point;
                                point_ = {m.position, m.normal};
                              },
                              [&](const measure::PixelRadiance& m) {
                                film_ = std::make_shared<const scene::FilmMap>(scene.camera(m.camera));
                                kind_ = Kind::pixel;
                                pixel_ = {m.x, m.y};
                              }},
             asked);
}

void MeasurementSampler::set_regions(std::span<const scene::SurfacePatch> patches) {
  std::vector<double> areas;
  for (const scene::SurfacePatch& patch : patches) {
    regions_.push_back({patch, patch.normal()});
    areas.push_back(patch.area);
  }
  pick_ = AliasTable(areas);
}

Spectrum MeasurementSampler::sample(const PathEstimator& paths, core::RandomNumbers& numbers) const {
  switch (kind_) {
    case Kind::point:
      return paths.irradiance(point_, numbers, path_block);
    case Kind::pixel:
      return film_sample(*film_, box(), pixel_, paths, numbers);
    case Kind::area:
      break;
  }
  std::uint32_t region = 0;
  if (regions_.size() > 1) {
    numbers.jump(pick_block);
    region = pick_.pick(numbers.next());
  }
  numbers.jump(place_block);
  const double u = numbers.next(), v = numbers.next();
  const auto& [patch, normal] = regions_[region];
  return scale_ * paths.irradiance({patch_point(patch, u, v), normal}, numbers, path_block);
}

}  // namespace interflect::montecarlo
