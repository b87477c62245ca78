#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "apps/camera_pictures.h"
#include "apps/commands.h"
#include "apps/first_pass.h"
#include "apps/picture_checkpoint.h"
#include "apps/read_scene.h"
#include "apps/require_paths.h"
#include "apps/scene_questions.h"
#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "measure/light_groups.h"
#include "montecarlo/integrators.h"
#include "montecarlo/render.h"
#include "montecarlo/sample_report.h"
#include "results/image_file.h"
#include "results/output_directory.h"
#include "results/record.h"
#include "results/tables.h"

namespace interflect::apps {
namespace {

/// What there is to say of samples (montecarlo::SampleReport).
struct SamplesTold {
  std::uint64_t not_finite = 0;
  std::size_t heavy = 0;  ///< measurements of which one sample is much
  std::string text = {};  ///< of the worst of these
  std::string rare = {};  ///< of light that samples may not have met
};

SamplesTold told_of(const montecarlo::Rendering& picture) {
  return {picture.report.not_finite, picture.report.heavy.size(),
          picture.report.heavy_text_of_picture(picture.radiance.width, picture.radiance.height), picture.report.rare};
}

std::vector<std::string> names_of(const scene::Scene& scene, const SceneQuestions& questions) {
  std::vector<std::string> names;
  for (const auto& side : questions.sides) names.push_back(name_of(scene, side));
  for (const measure::SensorPoint& point : questions.points)
    names.push_back(core::format("%s[%d]", point.sensor.c_str(), point.index));
  return names;
}

/// Surfaces and sensors by an integrator, in the columns that every method writes; a stopped run writes what it has.
/// @throws core::Interrupted  if it has nothing for some of them
void write_estimates(const scene::Scene& scene, const TraceOptions& options, const FirstPass& first, Run& run,
                     SamplesTold& told) {
  const SceneQuestions questions = questions_about(scene);
  std::vector<measure::Measurement> asked = questions.on_sides;
  asked.insert(asked.end(), questions.at_points.begin(), questions.at_points.end());
  montecarlo::IntegratorSettings settings;
  settings.target = options.accuracy;
  settings.intersector = options.intersector;
  settings.paths = measure::PathClasses::of(options.paths);
  montecarlo::SampleReport report;
  settings.report = &report;
  settings.solution = first.solution();
  const std::vector<Estimate> found =
      montecarlo::make_integrator(options.integrator, settings)->answer(scene, asked, run);
  std::vector<results::SurfaceRow> rows;
  const std::vector<Estimate> means = mean_irradiances(scene, questions, found);
  for (std::size_t k = 0; k < means.size(); ++k)
    rows.push_back(results::surface_row(scene, questions.sides[k].first, questions.sides[k].second, means[k]));
  results::write_surfaces_csv(options.estimates / "surfaces.csv", rows, scene);
  results::write_sensors_csv(options.estimates / "sensors.csv", questions.points,
                             std::span(found).subspan(means.size()), scene);
  const std::vector<std::string> names = names_of(scene, questions);
  told = {report.not_finite, report.heavy.size(), report.heavy_text(names), report.rare_text(names)};
}

/// What there is to tell at the end.
struct Traced {
  std::string camera;
  std::uint64_t samples;  ///< a pixel
  double error, dark;     ///< of pixels, as Rendering has them: relative, and the share of those without light
  double target;          ///< of that; 0: none
  bool met_target;
  bool by_noise;  ///< alone they err, and independently: errors fall as the root of the number of samples grows
  std::filesystem::path exr, png;
  bool stopped;                           ///< before all was done
  std::filesystem::path checkpoint = {};  ///< to go on from; empty where this run leaves none
  std::filesystem::path estimates = {};   ///< their folder; empty where none were written
  SamplesTold of_picture = {}, of_estimates = {};

  bool missed_target() const { return target > 0 && !met_target; }
};

bool errs_by_noise(const TraceOptions& options) {
  const montecarlo::IntegratorEntry& entry = montecarlo::integrator_entry(options.integrator);
  return options.sequence == "independent" && !entry.by_quadrature && !entry.inherits_error;
}

/// Writes them, if they were asked for and a stop leaves time for any.
void add_estimates(const scene::Scene& scene, const TraceOptions& options, const FirstPass& first, Run& run,
                   Traced& traced) {
  if (options.estimates.empty()) return;
  try {
    write_estimates(scene, options, first, run, traced.of_estimates);
  } catch (const core::Interrupted&) {
    core::log::warning("stopped: no estimates were written");
    traced.stopped = true;
    return;
  }
  traced.estimates = options.estimates;
  if (!run.stop.stop_requested()) return;
  core::log::warning("stopped: the estimates have fewer samples than --accuracy asks for");
  traced.stopped = true;
}

montecarlo::Rendering rendered(const scene::Scene& scene, scene::CameraId camera, const TraceOptions& options,
                               const FirstPass& first, PictureCheckpoint& checkpoint, Run& run) {
  montecarlo::FilmState state;
  montecarlo::RenderCheckpoints checkpoints;
  if (options.resume) {
    state = checkpoint.read();
    checkpoints.from = &state;
  }
  checkpoints.at_end = options.keep_checkpoint;
  checkpoints.keep = [&](const montecarlo::FilmState& now) { checkpoint.write(now); };
  const auto rays = raycast::make_ray_caster(options.intersector, scene);
  try {
    montecarlo::RenderSettings settings = render_settings(options);
    settings.solution = first.solution();
    return montecarlo::render(scene, camera, settings, run, *rays, checkpoints);
  } catch (const core::Interrupted&) {  // before there is a picture
    if (checkpoint.is_own()) core::log::warning("--resume goes on from " + checkpoint.file().string());
    throw;
  }
}

void print_text(const SamplesTold& told) {
  for (const std::string& line : {told.text, told.rare})
    if (!line.empty()) std::printf("%s\n", line.c_str());
  if (told.not_finite > 0)
    std::printf("%llu samples were not finite and count as zero: a bug\n",
                static_cast<unsigned long long>(told.not_finite));
}

/// "12 %", "130 %".
std::string error_text(double relative) {
  if (!std::isfinite(relative)) return "not known";
  const double percents = core::rounded_up(100 * relative, 2);
  return core::format(percents < 10 ? "%.2g %%" : "%.0f %%", percents);
}

/// Of a target that all samples asked for did not reach: why, and how many would at the least, where that can be told.
/// More find light in pixels that have none yet, which are noisy then.
void tell_of_missed_target(const Traced& t) {
  std::string text = core::format("--target %s was not met: pixels' standard errors are %s after %llu samples a pixel",
                                  core::format_percent(t.target).c_str(), error_text(t.error).c_str(),
                                  static_cast<unsigned long long>(t.samples));
  if (!t.of_picture.rare.empty())
    text += ", and do not know of all light: " + t.of_picture.rare;
  else if (t.by_noise && std::isfinite(t.error))
    text += core::format(", at least --spp %.0f would be needed",
                         core::rounded_up(static_cast<double>(t.samples) * std::pow(t.error / t.target, 2), 2));
  core::log::shortfall(text);
}

void print_text(const Traced& t) {
  std::printf("%s, %llu samples a pixel: %s and %s\n", t.camera.c_str(), static_cast<unsigned long long>(t.samples),
              t.exr.c_str(), t.png.c_str());
  if (t.dark < 1)
    std::printf("standard errors of pixels: %s (root mean square)%s\n", error_text(t.error).c_str(),
                t.dark > 0 ? (" of the " + core::format_percent(1 - t.dark) + " that found light").c_str() : "");
  else
    std::printf("no pixel found light\n");
  print_text(t.of_picture);
  if (!t.estimates.empty())
    std::printf("estimates: %s and %s\n", (t.estimates / "surfaces.csv").c_str(),
                (t.estimates / "sensors.csv").c_str());
  print_text(t.of_estimates);
  if (t.stopped) std::printf("stopped before all was done\n");
  if (!t.checkpoint.empty()) std::printf("--resume goes on from %s\n", t.checkpoint.c_str());
}

void add(const SamplesTold& told, const std::string& of, results::Record& record) {
  record.add(of + "samples_not_finite", told.not_finite).add(of + "by_one_sample", told.heavy);
  if (!told.text.empty()) record.add(of + "worst_by_one_sample", told.text);
  if (!told.rare.empty()) record.add(of + "rare_light", told.rare);
}

results::Record record_of(const Traced& t) {
  results::Record record;
  record.add("camera", t.camera).add("samples", t.samples).add("relative_error", t.error).add("dark", t.dark);
  if (t.target > 0) record.add("target", t.target).add("target_met", t.met_target);
  record.add("exr", t.exr.string()).add("png", t.png.string());
  add(t.of_picture, "pixels_", record);
  if (!t.estimates.empty()) {
    record.add("estimates", t.estimates.string());
    add(t.of_estimates, "estimates_", record);
  }
  if (!t.checkpoint.empty()) record.add("checkpoint", t.checkpoint.string());
  return record.add("stopped", t.stopped);
}

}  // namespace

ExitStatus trace(const TraceOptions& options, const CommonOptions& common, Run& run) {
  results::require_both_images(options.image);
  scene::Scene scene = read_and_note(options.scene);
  if (!options.group.empty()) scene = measure::lit_by(std::move(scene), options.group);
  const scene::CameraId camera = camera_named(scene, options.camera);
  require_paths(scene, options.paths);
  std::optional<results::OutputDirectory> pictures, estimates;
  if (options.image.has_parent_path()) pictures.emplace(options.image.parent_path());
  if (!options.estimates.empty()) estimates.emplace(options.estimates);
  PictureCheckpoint checkpoint(scene, camera, options, common);
  const FirstPass first(scene, {options.integrator}, measure::PathClasses::of(options.paths), options.intersector, run);
  first.require_solved();
  const montecarlo::Rendering rendering = rendered(scene, camera, options, first, checkpoint, run);
  Traced traced{.camera = scene.camera(camera).name,
                .samples = rendering.samples,
                .error = rendering.relative_error,
                .dark = rendering.dark,
                .target = options.target,
                .met_target = rendering.met_target,
                .by_noise = errs_by_noise(options),
                .exr = options.image,
                .png = options.image,
                .stopped = !rendering.complete};
  results::write_image(traced.exr.replace_extension(".exr"), with_errors_and_samples(rendering));
  results::write_image(traced.png.replace_extension(".png"), results::as_rgb(scene, rendering.radiance));
  traced.of_picture = told_of(rendering);
  add_estimates(scene, options, first, run, traced);
  const bool grows_on = traced.stopped || traced.missed_target() || options.keep_checkpoint;
  if (!grows_on) checkpoint.remove();  // after what it was for is written
  if (checkpoint.is_own()) traced.checkpoint = checkpoint.file();
  if (common.json)
    std::printf("%s\n", results::json_text(record_of(traced)).c_str());
  else if (!common.quiet)
    print_text(traced);
  if (!traced.stopped && traced.missed_target()) tell_of_missed_target(traced);
  return traced.stopped || traced.missed_target() ? not_met : success;
}

}  // namespace interflect::apps
