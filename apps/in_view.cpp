#include "apps/in_view.h"

#include <algorithm>

#include "core/log.h"
#include "results/tone_mapping.h"
#include "scene/film_map.h"

namespace interflect::apps {

namespace {
constexpr int rays_across = 200;  ///< of the picture: enough to know what it is of
}

std::vector<double> shares_in_view(const raycast::RayCaster& rays, const mesh::ElementMesh& mesh,
                                   const std::optional<scene::Camera>& camera) {
  std::vector<double> shares;
  for (const scene::SurfacePatch& patch : mesh.patches()) shares.push_back(camera ? 0.0 : patch.area);
  if (!camera) return shares;
  const scene::FilmMap film(*camera);
  const int step = std::max(1, camera->width / rays_across);
  for (int y = step / 2; y < camera->height; y += step)
    for (int x = step / 2; x < camera->width; x += step) {
      const auto ray = film.ray({x + 0.5, y + 0.5});
      const auto hit = ray ? rays.closest({ray->origin, ray->direction}) : std::nullopt;
      if (const auto element = hit ? mesh.locate(*hit) : std::nullopt) shares[element->element.value] += 1;
    }
  if (std::all_of(shares.begin(), shares.end(), [](double share) { return share == 0; }))
    core::log::warning("camera '" + camera->name + "' sees no side that light could leave: is it outside the room?");
  return shares;
}

visual::Range range_in_view(std::span<const double> values, std::span<const double> shares) {
  double most = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (shares[i] > 0) most = std::max(most, values[i]);
  const double usual = results::weighted_quantile(values, shares, 0.99);
  return {0, visual::round_up(most > 2 * usual ? usual : most)};
}

}  // namespace interflect::apps
