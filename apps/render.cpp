#include <cmath>
#include <cstdio>

#include "apps/camera_pictures.h"
#include "apps/commands.h"
#include "apps/solution_files.h"
#include "core/format.h"
#include "fem/point_of_view.h"
#include "fem/specular/specular_chains.h"
#include "results/image_file.h"

namespace interflect::apps {
namespace {

/// What there is to tell: of the pixels' own colours, weighed.
struct Rendered {
  std::string camera;
  int rays;  ///< a pixel
  double mean, mean_error;
  std::filesystem::path exr, png;
};

/// Of rays that meet mirrors or glass a few are mirrored and the others pass, by chance: with so many a pixel that is a
/// fine grain, and no speckle.  Where each goes on into a gather there are fewer: they cost more.
int rays_of(const RenderOptions& options, const scene::Scene& scene) {
  if (options.rays > 0) return options.rays;
  if (!fem::any_smooth(scene)) return rays_a_pixel;
  return options.gather ? rays_by_mirrors_gathered : rays_by_mirrors;
}

double weighed_mean(const scene::Scene& scene, const core::Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      Spectrum pixel;
      for (int c = 0; c < scene.channel_count(); ++c) pixel[c] = image.at(x, y, c);
      sum += scene.weigh(pixel);
    }
  return sum / (static_cast<double>(image.width) * image.height);
}

results::Record record_of(const Rendered& r) {
  results::Record record;
  return record.add("camera", r.camera)
      .add("rays", r.rays)
      .add("mean_radiance", r.mean)
      .add("mean_error", r.mean_error)
      .add("exr", r.exr.string())
      .add("png", r.png.string());
}

}  // namespace

ExitStatus render(const RenderOptions& options, const CommonOptions& common, Run& run) {
  if (options.solve.forecast_only) return print_forecast(options.solve, common, run);
  results::require_both_images(options.image);
  scene::Scene read = scene_to_solve(options.solve);
  const scene::CameraId camera = camera_named(read, options.camera);  // before the work
  fem::require_point_of_view(read.camera(camera));
  SolveOptions of_solve = options.solve;
  of_solve.out = options.image.has_parent_path() ? options.image.parent_path() : ".";
  const auto solved = solve_scene(std::move(read), of_solve, common, run);
  const scene::Scene& scene = solved->scene;
  const int side = static_cast<int>(std::lround(std::sqrt(rays_of(options, scene))));
  const CameraPicture picture =
      picture_of(fem::RadiosityMethod(solved->solution, *solved->rays, {side, options.gather}), scene, camera, run);
  Rendered rendered{scene.camera(camera).name,          side * side,   weighed_mean(scene, picture.radiance),
                    weighed_mean(scene, picture.error), options.image, options.image};
  results::write_image(rendered.exr.replace_extension(".exr"), with_errors(picture.radiance, picture.error));
  results::write_image(rendered.png.replace_extension(".png"), results::as_rgb(scene, picture.radiance));
  if (common.json)
    std::printf("%s\n", results::json_text(record_of(rendered)).c_str());
  else if (!common.quiet)
    std::printf(
        "%s, %d ray%s a pixel, mean radiance %.4g %s, pixels' errors %.2g %s in the mean (estimated): %s and %s\n",
        rendered.camera.c_str(), rendered.rays, rendered.rays == 1 ? "" : "s", rendered.mean, scene.radiance_unit(),
        rendered.mean_error, scene.radiance_unit(), rendered.exr.c_str(), rendered.png.c_str());
  return shortfalls_of(solved->solution, options.solve.settings).empty() ? success : not_met;
}

}  // namespace interflect::apps
