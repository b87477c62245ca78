#include <cstdio>

#include "apps/commands.h"
#include "apps/pictures.h"
#include "apps/solved_scene.h"
#include "core/error.h"
#include "core/format.h"
#include "measure/surface_measurements.h"
#include "montecarlo/path_tracer.h"
#include "montecarlo/render.h"
#include "results/atomic_file.h"
#include "results/image_file.h"
#include "results/record.h"
#include "results/tables.h"

namespace interflect::apps {
namespace {

scene::CameraId camera_named(const scene::Scene& scene, const std::string& name) {
  if (scene.cameras.empty()) throw core::InputError(scene.file.string(), "this scene has no camera to trace from");
  if (name.empty()) return {0};
  if (const auto id = scene.find_camera(name)) return *id;
  std::string known;
  for (const scene::Camera& camera : scene.cameras) known += (known.empty() ? "" : ", ") + camera.name;
  throw core::InputError("--camera " + name, scene.file.string() + " has " + known);
}

/// The channels of the picture, then their standard errors under NAME.error: one EXR that says how sure it is.
core::Image with_errors(const montecarlo::Rendering& rendering) {
  std::vector<std::string> names = rendering.radiance.channels;
  for (const std::string& name : rendering.radiance.channels) names.push_back(name + ".error");
  core::Image both(rendering.radiance.width, rendering.radiance.height, names);
  const int channels = static_cast<int>(rendering.radiance.channels.size());
  for (int y = 0; y < both.height; ++y)
    for (int x = 0; x < both.width; ++x)
      for (int c = 0; c < channels; ++c) {
        both.at(x, y, c) = rendering.radiance.at(x, y, c);
        both.at(x, y, channels + c) = rendering.standard_error.at(x, y, c);
      }
  return both;
}

/// Surfaces and sensors by path tracing, in the columns that every method writes.
void write_estimates(const scene::Scene& scene, const TraceOptions& options, Run& run) {
  std::vector<measure::Measurement> asked;
  std::vector<std::pair<scene::SurfaceId, scene::Side>> sides;
  for (scene::SurfaceId id : scene.surface_ids())
    for (scene::Side side : {scene::Side::front, scene::Side::back})
      if (scene.material(id).active(side)) {
        sides.emplace_back(id, side);
        asked.emplace_back(measure::Flux{measure::patches_of(scene, id, side)});
      }
  const auto points = measure::sensor_points(scene);
  for (const measure::SensorPoint& point : points) asked.emplace_back(point.at);
  montecarlo::PathTracerSettings settings;
  settings.target = options.accuracy;
  settings.intersector = options.intersector;
  const std::vector<Estimate> found = montecarlo::PathTracer(settings).answer(scene, asked, run);
  std::vector<results::SurfaceRow> rows;
  for (std::size_t k = 0; k < sides.size(); ++k)
    rows.push_back(results::surface_row(scene, sides[k].first, sides[k].second, scaled(found[k], 1 / scene.area(sides[k].first))));
  results::write_surfaces_csv(options.estimates / "surfaces.csv", rows, scene.channel_count());
  results::write_sensors_csv(options.estimates / "sensors.csv", points, std::span(found).subspan(sides.size()), scene.channel_count());
}

}  // namespace

ExitStatus trace(const TraceOptions& options, const CommonOptions& common, Run& run) {
  results::require_image_extension(options.image);
  const scene::Scene scene = read_and_note(options.scene);
  const scene::CameraId camera = camera_named(scene, options.camera);
  if (options.image.has_parent_path()) results::prepare_output_directory(options.image.parent_path());
  if (!options.estimates.empty()) results::prepare_output_directory(options.estimates);
  const auto samples = static_cast<std::uint64_t>(options.samples);
  const montecarlo::Rendering rendering = montecarlo::render(scene, camera, samples, run, options.intersector);
  std::filesystem::path exr = options.image, png = options.image;
  results::write_image(exr.replace_extension(".exr"), with_errors(rendering));
  results::write_image(png.replace_extension(".png"), as_rgb(scene, rendering.radiance));
  if (!options.estimates.empty() && !run.stop.stop_requested()) write_estimates(scene, options, run);
  if (common.json)
    std::printf("%s\n", results::json_text(results::Record().add("camera", scene.camera(camera).name)
                                               .add("samples", rendering.samples).add("exr", exr.string())
                                               .add("png", png.string())).c_str());
  else if (!common.quiet)
    std::printf("%s, %llu samples a pixel: %s and %s\n", scene.camera(camera).name.c_str(),
                static_cast<unsigned long long>(rendering.samples), exr.string().c_str(), png.string().c_str());
  return rendering.samples < samples ? not_met : success;
}

}  // namespace interflect::apps
