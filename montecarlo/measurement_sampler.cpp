#include "montecarlo/measurement_sampler.h"

#include "core/error.h"
#include "core/format.h"
#include "montecarlo/warp.h"

namespace interflect::montecarlo {

namespace {

// Dimensions: the place owns the first two blocks, whatever kind it is; the path owns the rest.
constexpr std::uint32_t place_block = 0, pick_block = 1, lens_block = 1, path_block = 2;
constexpr std::uint32_t second_path_block = 1u << 30;  // no path comes that far

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;  // clang 14 does not deduce aggregates

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

MeasurementSampler::MeasurementSampler(const scene::Scene& scene, const measure::Measurement& asked) {
  const auto patch = [&](const measure::PatchIrradiance& m) { set_regions({&m.patch, 1}); };
  const auto flux = [&](const measure::Flux& m) {
    set_regions(m.through);
    scale_ = pick_.total();
  };
  const auto point = [&](const measure::PointIrradiance& m) {
    if (!(std::abs(m.normal.norm() - 1) < 1e-9)) throw core::InputError("point irradiance", "a unit normal expected");
    kind_ = Kind::point;
    point_ = {m.position, m.normal};
  };
  const auto pixel = [&](const measure::PixelRadiance& m) {
    if (m.camera.value >= scene.cameras.size())
      throw core::InputError("pixel radiance", "a camera of the scene expected");
    const scene::Camera& camera = scene.camera(m.camera);
    scene::require_valid(camera);
    if (m.x < 0 || m.y < 0 || m.x >= camera.width || m.y >= camera.height)
      throw core::InputError(core::format("pixel (%d, %d)", m.x, m.y),
                             "a pixel of camera '" + camera.name + "' expected");
    film_ = std::make_shared<const scene::FilmMap>(camera);
    kind_ = Kind::pixel;
    scale_ = inv_pi;
    pixel_ = {m.x, m.y};
  };
  std::visit(Overloaded{patch, point, flux, pixel}, asked);
}

void MeasurementSampler::set_regions(std::span<const scene::SurfacePatch> patches) {
  std::vector<double> areas;
  for (const scene::SurfacePatch& patch : patches) {
    if (!(patch.area > 0) || patch.corners < 3 || patch.corners > 4)
      throw core::InputError("measured patch", "a triangle or quad with an area expected");
    regions_.push_back({patch, patch.normal()});
    areas.push_back(patch.area);
  }
  if (areas.empty()) throw core::InputError("measured flux", "at least one patch expected");
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
