#include "apps/field_pictures.h"

#include <algorithm>

#include "apps/display_or_warning.h"
#include "apps/pictures.h"
#include "core/log.h"
#include "results/image_file.h"
#include "results/tone_mapping.h"
#include "visual/picture.h"

namespace interflect::apps {
namespace {

using Camera = std::optional<scene::Camera>;

constexpr int rays_across = 200;  ///< of the picture: enough to know what it is of

/// How much of the picture each element is: the rays through a grid of its pixels that meet it; without a camera, its area.
std::vector<double> shares_in_view(const SolvedScene& solved, const Camera& camera) {
  const mesh::ElementMesh& mesh = solved.solution.mesh;
  std::vector<double> shares;
  for (const scene::SurfacePatch& patch : mesh.patches()) shares.push_back(camera ? 0.0 : patch.area);
  if (!camera) return shares;
  const int step = std::max(1, camera->width / rays_across);
  for (int y = step / 2; y < camera->height; y += step)
    for (int x = step / 2; x < camera->width; x += step) {
      const auto hit = solved.rays->closest({camera->eye, camera->direction(x + 0.5, y + 0.5)});
      if (const auto element = hit ? mesh.locate(*hit) : std::nullopt) shares[element->element.value] += 1;
    }
  if (std::all_of(shares.begin(), shares.end(), [](double share) { return share == 0; }))
    core::log::warning("camera '" + camera->name + "' sees no side that light could leave: is it outside the room?");
  return shares;
}

/// The 98th percentile of what is in view and does not emit: a lamp must not turn the room black.
double white_of(const SolvedScene& solved, std::span<const std::array<double, 3>> rgb, std::span<const double> shares) {
  std::vector<double> values, weights;
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    if (!solved.solution.exitance[i].is_zero()) continue;
    values.push_back(std::max({rgb[i][0], rgb[i][1], rgb[i][2]}));
    weights.push_back(shares[i]);
  }
  return results::weighted_quantile(values, weights, 0.98);  // 0, the picture's own choice, where all emits
}

/// 0 to the most that is in view, or to its 99th percentile where the most is more than twice that.
visual::Range range_in_view(std::span<const double> values, std::span<const double> shares) {
  double most = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (shares[i] > 0) most = std::max(most, values[i]);
  const double usual = results::weighted_quantile(values, shares, 0.99);
  return {0, visual::round_up(most > 2 * usual ? usual : most)};
}

core::Image radiosity_picture(const visual::Display& display, const SolvedScene& solved, const Camera& camera,
                              std::span<const double> shares) {
  std::vector<std::array<double, 3>> rgb;
  for (const Spectrum& B : solved.solution.radiosity) rgb.push_back(solved.scene.rgb(B * inv_pi));
  return visual::true_colour(display, solved.scene, solved.solution.mesh, rgb,
                             {.caption = {}, .white = white_of(solved, rgb, shares), .camera = camera});
}

core::Image irradiance_picture(const visual::Display& display, const SolvedScene& solved, const Camera& camera,
                               std::span<const double> shares) {
  std::vector<double> values;
  for (const Spectrum& H : solved.solution.irradiance) values.push_back(solved.scene.weigh(H));
  const bool photometric = solved.scene.quantity == scene::Quantity::photometric;
  const std::string title = std::string(photometric ? "illuminance [" : "irradiance [") + solved.scene.irradiance_unit() + "]";
  return visual::false_colour(display, solved.scene, solved.solution.mesh, values,
                              {.title = title, .caption = {}, .range = range_in_view(values, shares), .camera = camera});
}

}  // namespace

void write_field_pictures(const SolvedScene& solved, const std::filesystem::path& folder) {
  const auto display = display_or_warning();
  if (!display) return;
  std::vector<Camera> cameras(solved.scene.cameras.begin(), solved.scene.cameras.end());
  if (cameras.empty()) cameras.emplace_back();
  for (std::size_t k = 0; k < cameras.size(); ++k) {
    const std::vector<double> shares = shares_in_view(solved, cameras[k]);
    results::write_png(folder / picture_file("radiosity", k), radiosity_picture(*display, solved, cameras[k], shares));
    results::write_png(folder / picture_file("irradiance", k), irradiance_picture(*display, solved, cameras[k], shares));
  }
}

}  // namespace interflect::apps
