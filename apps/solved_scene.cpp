#include "apps/solved_scene.h"

#include <cstdio>

#include "core/format.h"
#include "core/log.h"
#include "results/atomic_file.h"
#include "scene/reader.h"

namespace interflect::apps {
namespace {

std::vector<Estimate> answer_points(const SolvedScene& solved, Run& run) {
  std::vector<measure::Measurement> asked;
  for (const measure::SensorPoint& point : solved.points) asked.emplace_back(point.at);
  return solved.method().answer(solved.scene, asked, run);
}

}  // namespace

scene::Scene read_and_note(const std::filesystem::path& file) {
  scene::Scene scene = scene::read_scene(file);
  for (const scene::Note& note : scene.repairs) core::log::info(note.place + ": " + note.message);
  for (const scene::Note& note : scene.warnings) core::log::warning(note.place + ": " + note.message);
  return scene;
}

std::string describe(const fem::Forecast& forecast) {
  return core::format("%s elements, %s, about %s", core::format_count(static_cast<unsigned long long>(forecast.elements)).c_str(),
                      core::format_bytes(forecast.bytes).c_str(), core::format_duration(forecast.seconds).c_str());
}

std::unique_ptr<SolvedScene> solve_scene(const SolveOptions& options, const CommonOptions& common, Run& run) {
  scene::Scene scene = read_and_note(options.scene);
  const fem::Forecast forecast = fem::forecast(scene, options.settings, run);
  if (!options.forecast_only) results::prepare_output_directory(options.out);
  if (!common.json && !common.quiet) std::printf("%s\n", describe(forecast).c_str());
  std::fflush(stdout);
  if (options.forecast_only) return nullptr;
  auto solution = fem::solve_radiosity(scene, options.settings, run);
  auto points = measure::sensor_points(scene);
  auto solved = std::make_unique<SolvedScene>(std::move(scene), forecast, std::move(solution), std::move(points));
  solved->rays = raycast::make_ray_caster(options.settings.intersector, solved->scene);
  solved->at_points = answer_points(*solved, run);
  return solved;
}

}  // namespace interflect::apps
