#include "montecarlo/measurement_sampler.h"

#include "core/error.h"
#include "core/format.h"
#include "montecarlo/warp.h"

namespace interflect::montecarlo {

namespace {

// Dimensions: the place owns the first two blocks, whatever kind it is; the path owns the rest.
constexpr std::uint32_t place_block = 0, pick_block = 1, path_block = 2;

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;  // clang 14 does not deduce aggregates

}  // namespace

Spectrum pixel_sample(const scene::Camera& camera, int x, int y, const PathEstimator& paths,
                      core::RandomNumbers& numbers) {
  numbers.jump(place_block);
  const double u = numbers.next(), v = numbers.next();
  return paths.radiance(camera.eye, camera.direction(x + u, y + v), numbers, path_block);
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
    camera_ = &scene.camera(m.camera);
    if (m.x < 0 || m.y < 0 || m.x >= camera_->width || m.y >= camera_->height)
      throw core::InputError(core::format("pixel (%d, %d)", m.x, m.y),
                             "a pixel of camera '" + camera_->name + "' expected");
    kind_ = Kind::pixel;
    scale_ = inv_pi;
    x_ = m.x, y_ = m.y;
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
      return pixel_sample(*camera_, x_, y_, paths, numbers);
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
