#include "montecarlo/splat_targets.h"

#include <map>
#include <numeric>

namespace interflect::montecarlo {
namespace {

SplatTargets::Film film_of(const scene::Camera& camera, const ReconstructionFilter& filter) {
  const auto pixels = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  return {scene::FilmMap(camera), camera.width, camera.height,
          std::vector<std::uint32_t>(pixels, SplatTargets::Film::none), filter};
}

}  // namespace

SplatTargets::SplatTargets(const scene::Scene& scene, std::span<const measure::Measurement> asked) {
  std::map<std::uint32_t, std::size_t> of_camera;
  for (std::uint32_t m = 0; m < asked.size(); ++m) {
    if (const auto* point = std::get_if<measure::PointIrradiance>(&asked[m]))
      points_.push_back({m, point->position, point->normal});
    const auto* pixel = std::get_if<measure::PixelRadiance>(&asked[m]);
    if (!pixel) continue;
    const scene::Camera& camera = scene.camera(pixel->camera);
    const auto [at, is_new] = of_camera.try_emplace(pixel->camera.value, films_.size());
    if (is_new) films_.push_back(film_of(camera, box_filter()));
    Film& film = films_[at->second];
    std::uint32_t& of_pixel =
        film.measurement[static_cast<std::size_t>(pixel->y) * static_cast<std::size_t>(film.width) +
                         static_cast<std::size_t>(pixel->x)];
    if (of_pixel == Film::none)
      of_pixel = m;
    else
      again_.emplace_back(m, of_pixel);
  }
}

SplatTargets::SplatTargets(const scene::Camera& camera, const ReconstructionFilter& filter) {
  films_.push_back(film_of(camera, filter));
  std::iota(films_[0].measurement.begin(), films_[0].measurement.end(), 0u);
}

}  // namespace interflect::montecarlo
