#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "apps/camera_pictures.h"
#include "apps/commands.h"
#include "apps/comparison_pictures.h"
#include "apps/comparison_report.h"
#include "apps/first_pass.h"
#include "apps/read_scene.h"
#include "apps/require_paths.h"
#include "apps/scene_questions.h"
#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "core/seconds_since.h"
#include "results/atomic_file.h"
#include "results/output_directory.h"
#include "validation/statistics.h"

namespace interflect::apps {
namespace {

using montecarlo::IntegratorPair;
using Kind = ComparedKind;
using Compared = IntegratorsCompared;

constexpr double alpha = 0.01;          ///< that chance alone makes any comparison of a run stand out
constexpr int most_coarse_pixels = 12;  ///< a row or column, that are held against each other

/// The same view by so few pixels that each may be known well.
scene::Camera coarse(const scene::Camera& camera) {
  scene::Camera few = camera;
  const double part = std::min(1.0, double{most_coarse_pixels} / std::max(camera.width, camera.height));
  few.width = std::max(1, static_cast<int>(std::lround(part * camera.width)));
  few.height = std::max(1, static_cast<int>(std::lround(part * camera.height)));
  return few;
}

/// @param camera  a coarse one, if there is one
std::vector<Kind> kinds_of(const scene::Scene& scene, std::optional<scene::CameraId> camera) {
  const SceneQuestions questions = questions_about(scene);
  std::vector<Kind> kinds(3);
  kinds[0] = {"surfaces", {}, questions.on_sides};
  measure::Flux all;
  for (std::size_t k = 0; k < questions.sides.size(); ++k) {
    kinds[0].names.push_back(name_of(scene, questions.sides[k]));
    for (const auto& patch : std::get<measure::Flux>(questions.on_sides[k]).through) all.through.push_back(patch);
  }
  kinds[0].names.emplace_back("all surfaces");  // a part that is lost everywhere shows here sooner than in any one
  kinds[0].asked.emplace_back(std::move(all));
  kinds[1] = {"sensors", {}, questions.at_points};
  for (const measure::SensorPoint& point : questions.points)
    kinds[1].names.push_back(core::format("%s[%d]", point.sensor.c_str(), point.index));
  kinds[2].name = "pixels";
  if (camera)
    for (int y = 0; y < scene.camera(*camera).height; ++y)
      for (int x = 0; x < scene.camera(*camera).width; ++x) {
        kinds[2].names.push_back(core::format("(%d, %d)", x, y));
        kinds[2].asked.emplace_back(measure::PixelRadiance{*camera, x, y});
      }
  std::erase_if(kinds, [](const Kind& kind) { return kind.asked.empty(); });
  return kinds;
}

std::vector<Compared> compared(const scene::Scene& scene, const std::vector<Kind>& kinds,
                               const std::vector<std::string>& names, const FirstPass& first_pass,
                               const CompareOptions& options, Run& run) {
  montecarlo::IntegratorSettings settings;
  settings.target = options.target;
  settings.intersector = options.intersector;
  settings.paths = measure::PathClasses::of(options.paths);
  settings.solution = first_pass.solution();
  std::vector<Compared> all;
  for (const Kind& kind : kinds) {
    if (!all.empty() && run.stop.stop_requested()) {
      core::log::warning("stopped: " + kind.name + " were not compared");
      continue;
    }
    const montecarlo::ComparisonSettings comparison{options.replications, kind.name};
    all.push_back({kind, compare_integrators(scene, kind.asked, names, settings, run, comparison), {}, {}});
  }
  return all;
}

/// @return  the largest z that chance allows among all comparisons
double judge(const scene::Scene& scene, std::vector<Compared>& all) {
  std::size_t comparisons = 0;
  for (const Compared& of : all)
    comparisons += of.comparison.pairs.size() * (validation::comparisons_of(scene, of.kind.asked.size()) + 1);
  comparisons = std::max<std::size_t>(1, comparisons);
  const double z_max = validation::sidak_z_max(alpha, comparisons), level = validation::sidak_level(alpha, comparisons);
  for (Compared& of : all)
    for (const IntegratorPair& pair : of.comparison.pairs) {
      of.agreements.push_back(validation::agreement(scene, pair.of_a, pair.of_b, z_max));
      of.means.push_back(
          validation::mean_agreement(scene, {pair.of_a, pair.again_a}, {pair.of_b, pair.again_b}, level));
    }
  return z_max;
}

/// Of all integrators those that need no solution of another method, and do not wait for chance.
std::vector<std::string> those_by_themselves() {
  std::vector<std::string> names;
  for (const montecarlo::IntegratorEntry& each : montecarlo::known_integrators())
    if (!each.needs_solution && !each.by_chance) names.push_back(each.name);
  return names;
}

}  // namespace

ExitStatus compare(const CompareOptions& options, const CommonOptions& common, Run& run) {
  const auto begin = std::chrono::steady_clock::now();
  scene::Scene scene = read_and_note(options.scene);
  require_paths(scene, options.paths);
  std::optional<scene::CameraId> camera, few;
  if (!scene.cameras.empty() || !options.camera.empty()) {
    camera = camera_named(scene, options.camera);
    few = scene::CameraId{static_cast<std::uint32_t>(scene.cameras.size())};
    scene.cameras.push_back(coarse(scene.camera(*camera)));
  }
  const std::vector<std::string> names = options.integrators.empty() ? those_by_themselves() : options.integrators;
  const results::OutputDirectory out(options.out);
  remove_comparison_pictures(options.out);
  const FirstPass first_pass(scene, names, measure::PathClasses::of(options.paths), options.intersector, run);
  std::vector<Compared> all = compared(scene, kinds_of(scene, few), names, first_pass, options, run);
  const double z_max = judge(scene, all);
  PicturesDrawn pictures;
  const auto times = [&] {
    TimesSpent spent = times_spent(all, first_pass.solution(), pictures);
    spent.elapsed = core::seconds_since(begin);
    return spent;
  };
  const auto record = [&] {
    return comparison_record(scene, all, options, z_max, run.stop.stop_requested(), pictures, times());
  };
  const auto write_record = [&] { results::write_json(options.out / "compare.json", record()); };
  results::write_atomically(options.out / "compare.csv", comparison_csv(scene, all));
  write_record();
  const bool talk = !common.json && !common.quiet;
  if (talk) std::printf("%s", comparison_text(scene, all, options.target, z_max).c_str());
  std::fflush(stdout);
  if (options.pictures && camera) {
    pictures = write_comparison_pictures(scene, *camera, names, first_pass, options, run);
    write_record();  // with them, and with a stop among them
    if (talk) std::printf("%s", pictures_text(pictures).c_str());
  }
  if (common.json) std::printf("%s\n", results::json_text(record()).c_str());
  if (talk) std::printf("%s", times_text(times()).c_str());
  if (talk) std::printf("written to %s\n", options.out.string().c_str());
  return all_agree(all) && !run.stop.stop_requested() ? success : not_met;
}

}  // namespace interflect::apps
