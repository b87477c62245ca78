#include "apps/field_pictures.h"

#include <algorithm>

#include "core/error.h"
#include "core/log.h"
#include "results/image_file.h"
#include "results/tone_mapping.h"
#include "visual/picture.h"

namespace interflect::apps {
namespace {

/// The 98th percentile, by area, of what does not emit: a lamp in view must not turn the room black.
double white_of(const SolvedScene& solved, std::span<const std::array<double, 3>> rgb) {
  std::vector<double> values, areas;
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    if (!solved.solution.exitance[i].is_zero()) continue;
    values.push_back(std::max({rgb[i][0], rgb[i][1], rgb[i][2]}));
    areas.push_back(solved.solution.mesh.patches()[i].area);
  }
  return results::weighted_quantile(values, areas, 0.98);  // 0, the picture's own choice, where all emits
}

core::Image radiosity_picture(const visual::Display& display, const SolvedScene& solved, const std::optional<scene::Camera>& camera) {
  std::vector<std::array<double, 3>> rgb;
  for (const Spectrum& B : solved.solution.radiosity) rgb.push_back(solved.scene.rgb(B * inv_pi));
  return visual::true_colour(display, solved.scene, solved.solution.mesh, rgb, {.caption = {}, .white = white_of(solved, rgb), .camera = camera});
}

core::Image irradiance_picture(const visual::Display& display, const SolvedScene& solved, const std::optional<scene::Camera>& camera) {
  std::vector<double> values;
  for (const Spectrum& H : solved.solution.irradiance) values.push_back(solved.scene.weigh(H));
  const bool photometric = solved.scene.quantity == scene::Quantity::photometric;
  const std::string title = std::string(photometric ? "illuminance [" : "irradiance [") + solved.scene.irradiance_unit() + "]";
  return visual::false_colour(display, solved.scene, solved.solution.mesh, values, {.title = title, .caption = {}, .camera = camera});
}

/// Null, with a warning, where no display can be had: a machine without one is no reason to lose a solution.
std::unique_ptr<visual::Display> display_or_warning() {
  try {
    return std::make_unique<visual::Display>();
  } catch (const core::InputError& error) {
    core::log::warning(std::string("no pictures: ") + error.what());
    return nullptr;
  }
}

}  // namespace

void write_field_pictures(const SolvedScene& solved, const std::filesystem::path& folder) {
  const auto display = display_or_warning();
  if (!display) return;
  std::optional<scene::Camera> camera;
  if (!solved.scene.cameras.empty()) camera = solved.scene.cameras.front();
  results::write_png(folder / "radiosity.png", radiosity_picture(*display, solved, camera));
  results::write_png(folder / "irradiance.png", irradiance_picture(*display, solved, camera));
}

}  // namespace interflect::apps
