#include "apps/field_pictures.h"

#include <algorithm>

#include "apps/camera_pictures.h"
#include "apps/display_or_warning.h"
#include "apps/in_view.h"
#include "apps/pictures.h"
#include "apps/proved_bounds.h"
#include "results/image_file.h"
#include "results/tone_mapping.h"
#include "visual/picture.h"

namespace interflect::apps {
namespace {

using Camera = std::optional<scene::Camera>;

using Rgb = std::array<double, 3>;

std::vector<Rgb> radiances(const scene::Scene& scene, std::span<const Spectrum> radiosity) {
  std::vector<Rgb> rgb;
  for (const Spectrum& B : radiosity) rgb.push_back(scene.rgb(B * inv_pi));
  return rgb;
}

std::vector<double> weighed(const scene::Scene& scene, std::span<const Spectrum> spectra) {
  std::vector<double> values;
  for (const Spectrum& spectrum : spectra) values.push_back(scene.weigh(spectrum));
  return values;
}

/// The 98th percentile of what is in view and does not emit: a lamp must not turn the room black.
double white_of(const scene::Scene& scene, const PictureScale& scale, std::span<const double> shares) {
  const std::vector<Rgb> rgb = radiances(scene, scale.radiosity);
  std::vector<double> values, weights;
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    if (!scale.exitance[i].is_zero()) continue;
    values.push_back(std::max({rgb[i][0], rgb[i][1], rgb[i][2]}));
    weights.push_back(shares[i]);
  }
  return results::weighted_quantile(values, weights, 0.98);  // 0, the picture's own choice, where all emits
}

core::Image radiosity_picture(const visual::Display& display, const SolvedScene& solved, const Camera& camera,
                              std::span<const double> shares, const SmoothField* field, const PictureScale& scale) {
  const visual::TrueColour look{
      .caption = {}, .note = scale.note, .white = white_of(solved.scene, scale, shares), .camera = camera};
  if (!field || !(look.white > 0))
    return visual::true_colour(display, solved.scene, solved.solution.mesh,
                               radiances(solved.scene, solved.solution.radiosity), look);
  return visual::true_colour(display, solved.scene, solved.solution.mesh, field->mesh,
                             radiances(solved.scene, field->radiosity), look);
}

std::string quantity_of(const scene::Scene& scene) {
  return scene.quantity == scene::Quantity::photometric ? "illuminance" : "irradiance";
}

core::Image irradiance_picture(const visual::Display& display, const SolvedScene& solved, const Camera& camera,
                               std::span<const double> shares, const SmoothField* field, const PictureScale& scale) {
  const visual::FalseColour look{.title = quantity_of(solved.scene) + " [" + solved.scene.irradiance_unit() + "]",
                                 .caption = {},
                                 .note = scale.note,
                                 .range = range_in_view(weighed(solved.scene, scale.irradiance), shares),
                                 .camera = camera};
  if (!field)
    return visual::false_colour(display, solved.scene, solved.solution.mesh,
                                weighed(solved.scene, solved.solution.irradiance), look);
  return visual::false_colour(display, solved.scene, solved.solution.mesh, field->mesh,
                              weighed(solved.scene, field->irradiance), look);
}

/// How far elements' mean irradiance may be off: proved.  By orders of magnitude, and not as a part of it: in the dark
/// everything may be off by all that it is.
core::Image bounds_picture(const visual::Display& display, const SolvedScene& solved, const Camera& camera,
                           std::span<const double> shares) {
  std::vector<double> values;
  for (std::size_t i = 0; i < solved.solution.irradiance.size(); ++i) {
    const Interval& H = solved.bounds->enclosure.mean_irradiance()[i];
    values.push_back(0.5 * solved.scene.weigh(H.upper - H.lower));
  }
  const visual::FalseColour look{
      .title = quantity_of(solved.scene) + " known within \xc2\xb1 [" + solved.scene.irradiance_unit() + "]",
      .caption = {},
      .range = visual::logarithmic_range(values, shares),
      .camera = camera};
  return visual::false_colour(display, solved.scene, solved.solution.mesh, values, look);
}

void add(std::vector<Spectrum>& sum, std::span<const Spectrum> values) {
  sum.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) sum[i] += values[i];
}

}  // namespace

PictureScale scale_of(const fem::RadiositySolution& solution) {
  if (solution.of_groups.empty()) return {solution.exitance, solution.radiosity, solution.irradiance, {}};
  PictureScale scale;
  for (const fem::RadiositySolution& group : solution.of_groups) {
    add(scale.exitance, group.exitance);
    add(scale.radiosity, group.radiosity);
    add(scale.irradiance, group.irradiance);
  }
  return scale;
}

void write_field_pictures(const SolvedScene& solved, const SmoothField* field, const std::filesystem::path& folder,
                          const PictureScale& scale) {
  const auto display = display_or_warning();
  if (!display) return;
  struct View {
    Camera camera;
    std::size_t place;  ///< among the scene's, which names the files
  };
  std::vector<View> views;
  for (const scene::CameraId id : drawable_cameras(solved.scene))
    views.push_back({solved.scene.camera(id), std::size_t{id.value}});
  if (views.empty()) views.push_back({{}, 0});
  for (const auto& [camera, k] : views) {
    const std::vector<double> shares = shares_in_view(*solved.rays, solved.solution.mesh, camera);
    results::write_png(folder / picture_file("radiosity", k),
                       radiosity_picture(*display, solved, camera, shares, field, scale));
    results::write_png(folder / picture_file("irradiance", k),
                       irradiance_picture(*display, solved, camera, shares, field, scale));
    if (solved.bounds)
      results::write_png(folder / picture_file("bounds", k), bounds_picture(*display, solved, camera, shares));
  }
}

}  // namespace interflect::apps
