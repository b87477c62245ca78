#include "montecarlo/splat_targets.h"

#include <cmath>
#include <map>

namespace interflect::montecarlo {

SplatTargets::SplatTargets(const scene::Scene& scene, std::span<const measure::Measurement> asked) {
  std::map<std::uint32_t, std::size_t> film_of;  // by camera
  for (std::uint32_t m = 0; m < asked.size(); ++m) {
    if (const auto* point = std::get_if<measure::PointIrradiance>(&asked[m]))
      points_.push_back({m, point->position, point->normal});
    const auto* pixel = std::get_if<measure::PixelRadiance>(&asked[m]);
    if (!pixel) continue;
    const scene::Camera& camera = scene.camera(pixel->camera);
    const auto [at, is_new] = film_of.try_emplace(pixel->camera.value, films_.size());
    if (is_new)
      films_.push_back(
          {scene::FilmMap(camera), camera.width, camera.height,
           std::vector<std::uint32_t>(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height),
                                      Film::none)});
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

std::uint32_t SplatTargets::Film::at(const Vec2& film) const {
  const double x = std::floor(film.x()), y = std::floor(film.y());
  if (!(x >= 0 && y >= 0 && x < width && y < height)) return none;
  return measurement[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
}

}  // namespace interflect::montecarlo
