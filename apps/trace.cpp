#include <algorithm>
#include <cstdio>
#include <optional>

#include "apps/camera_pictures.h"
#include "apps/commands.h"
#include "apps/picture_checkpoint.h"
#include "apps/read_scene.h"
#include "apps/scene_questions.h"
#include "core/error.h"
#include "core/log.h"
#include "montecarlo/integrators.h"
#include "montecarlo/render.h"
#include "results/image_file.h"
#include "results/output_directory.h"
#include "results/record.h"
#include "results/tables.h"

namespace interflect::apps {
namespace {

/// Surfaces and sensors by an integrator, in the columns that every method writes; a stopped run writes what it has.
/// @throws core::Interrupted  if it has nothing for some of them
void write_estimates(const scene::Scene& scene, const TraceOptions& options, Run& run) {
  const SceneQuestions questions = questions_about(scene);
  std::vector<measure::Measurement> asked = questions.on_sides;
  asked.insert(asked.end(), questions.at_points.begin(), questions.at_points.end());
  montecarlo::IntegratorSettings settings;
  settings.target = options.accuracy;
  settings.intersector = options.intersector;
  settings.paths = measure::PathClasses::of(options.paths);
  const std::vector<Estimate> found =
      montecarlo::make_integrator(options.integrator, settings)->answer(scene, asked, run);
  std::vector<results::SurfaceRow> rows;
  const std::vector<Estimate> means = mean_irradiances(scene, questions, found);
  for (std::size_t k = 0; k < means.size(); ++k)
    rows.push_back(results::surface_row(scene, questions.sides[k].first, questions.sides[k].second, means[k]));
  results::write_surfaces_csv(options.estimates / "surfaces.csv", rows, scene);
  results::write_sensors_csv(options.estimates / "sensors.csv", questions.points,
                             std::span(found).subspan(means.size()), scene);
}

/// What there is to tell at the end.
struct Traced {
  std::string camera;
  std::uint64_t samples;  ///< a pixel
  std::filesystem::path exr, png;
  std::filesystem::path checkpoint;  ///< to go on from; empty where the run was not stopped
  std::filesystem::path estimates;   ///< their folder; empty where none were written
  bool stopped;
};

/// The folder of the estimates; empty where none were asked for, or a stop came before there were any.
std::filesystem::path estimates_written(const scene::Scene& scene, const TraceOptions& options, Run& run) {
  if (options.estimates.empty()) return {};
  try {
    write_estimates(scene, options, run);
  } catch (const core::Interrupted&) {
    core::log::warning("stopped: no estimates were written");
    return {};
  }
  if (run.stop.stop_requested())
    core::log::warning("stopped: the estimates have fewer samples than --accuracy asks for");
  return options.estimates;
}

bool grows(const TraceOptions& options) {
  return options.integrator == "path" || options.integrator == "bidirectional";
}

/// All pixels asked for at once: by those whose pictures do not grow.
montecarlo::Rendering asked_for(const scene::Scene& scene, scene::CameraId camera, const TraceOptions& options,
                                Run& run) {
  if (options.resume || options.filter != "box" || options.sequence != "independent" || options.target > 0)
    throw core::InputError("--integrator " + options.integrator,
                           "pictures by it take no --resume, --filter, --sequence or --target");
  const scene::Camera& view = scene.camera(camera);
  const auto pixels = static_cast<std::uint64_t>(view.width) * static_cast<std::uint64_t>(view.height),
             samples = static_cast<std::uint64_t>(options.samples);
  montecarlo::IntegratorSettings settings;
  settings.samples = montecarlo::integrator_entry(options.integrator).shares_paths ? samples * pixels : samples;
  settings.intersector = options.intersector;
  settings.paths = measure::PathClasses::of(options.paths);
  const CameraPicture picture =
      picture_of(*montecarlo::make_integrator(options.integrator, settings), scene, camera, run);
  montecarlo::Rendering found{picture.radiance, picture.error, {view.width, view.height, {"samples"}}, samples};
  for (float& each : found.standard_error.data) each /= static_cast<float>(normal_95);
  std::fill(found.samples_a_pixel.data.begin(), found.samples_a_pixel.data.end(), static_cast<float>(samples));
  return found;
}

montecarlo::Rendering rendered(const scene::Scene& scene, scene::CameraId camera, const TraceOptions& options,
                               const PictureCheckpoint& checkpoint, Run& run) {
  if (!grows(options)) return asked_for(scene, camera, options, run);
  montecarlo::FilmState state;
  montecarlo::RenderCheckpoints checkpoints;
  if (options.resume) {
    state = checkpoint.read();
    checkpoints.from = &state;
  }
  checkpoints.keep = [&](const montecarlo::FilmState& now) { checkpoint.write(now); };
  const auto rays = raycast::make_ray_caster(options.intersector, scene);
  try {
    return montecarlo::render(scene, camera, render_settings(options), run, *rays, checkpoints);
  } catch (const core::Interrupted&) {  // before there is a picture
    core::log::warning("--resume goes on from " + checkpoint.file().string());
    throw;
  }
}

void print_text(const Traced& t) {
  std::printf("%s, %llu samples a pixel: %s and %s\n", t.camera.c_str(), static_cast<unsigned long long>(t.samples),
              t.exr.c_str(), t.png.c_str());
  if (!t.estimates.empty())
    std::printf("estimates: %s and %s\n", (t.estimates / "surfaces.csv").c_str(),
                (t.estimates / "sensors.csv").c_str());
  if (t.stopped)
    std::printf("stopped before all was done%s\n",
                t.checkpoint.empty() ? "" : (": --resume goes on from " + t.checkpoint.string()).c_str());
}

results::Record record_of(const Traced& t) {
  results::Record record;
  record.add("camera", t.camera).add("samples", t.samples).add("exr", t.exr.string()).add("png", t.png.string());
  if (!t.estimates.empty()) record.add("estimates", t.estimates.string());
  if (!t.checkpoint.empty()) record.add("checkpoint", t.checkpoint.string());
  return record.add("stopped", t.stopped);
}

}  // namespace

ExitStatus trace(const TraceOptions& options, const CommonOptions& common, Run& run) {
  results::require_image_extension(options.image);
  const scene::Scene scene = read_and_note(options.scene);
  const scene::CameraId camera = camera_named(scene, options.camera);
  std::optional<results::OutputDirectory> pictures, estimates;
  if (options.image.has_parent_path()) pictures.emplace(options.image.parent_path());
  if (!options.estimates.empty()) estimates.emplace(options.estimates);
  const PictureCheckpoint checkpoint(scene, camera, options, common);
  const montecarlo::Rendering rendering = rendered(scene, camera, options, checkpoint, run);
  Traced traced{scene.camera(camera).name, rendering.samples, options.image, options.image, {}, {}, false};
  if (run.stop.stop_requested() && grows(options)) traced.checkpoint = checkpoint.file();
  results::write_image(
      traced.exr.replace_extension(".exr"),
      with_channels(with_errors(rendering.radiance, rendering.standard_error), rendering.samples_a_pixel));
  results::write_image(traced.png.replace_extension(".png"), results::as_rgb(scene, rendering.radiance));
  traced.estimates = estimates_written(scene, options, run);
  traced.stopped = run.stop.stop_requested();
  if (common.json)
    std::printf("%s\n", results::json_text(record_of(traced)).c_str());
  else if (!common.quiet)
    print_text(traced);
  return traced.stopped ? not_met : success;
}

}  // namespace interflect::apps
