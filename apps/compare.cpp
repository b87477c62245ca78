#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "apps/camera_pictures.h"
#include "apps/commands.h"
#include "apps/first_pass.h"
#include "apps/pictures.h"
#include "apps/read_scene.h"
#include "apps/scene_questions.h"
#include "apps/table.h"
#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "montecarlo/integrator_comparison.h"
#include "montecarlo/measurable.h"
#include "montecarlo/tally.h"
#include "results/atomic_file.h"
#include "results/comparison_panels.h"
#include "results/csv.h"
#include "results/image_file.h"
#include "results/output_directory.h"
#include "results/record.h"
#include "validation/agreement.h"
#include "validation/statistics.h"

namespace interflect::apps {
namespace {

using montecarlo::IntegratorComparison;
using montecarlo::IntegratorPair;
using montecarlo::IntegratorTrial;
using validation::Agreement;
using validation::MeanAgreement;

constexpr double alpha = 0.01;            ///< that chance alone makes any comparison of a run stand out
constexpr int most_coarse_pixels = 12;    ///< a row or column, that are held against each other
constexpr double difference_scale = 0.1;  ///< relative difference at full colour

/// What is asked, of one kind.
struct Kind {
  std::string name;
  std::vector<std::string> names;
  std::vector<measure::Measurement> asked;
};
struct Compared {
  Kind kind;
  IntegratorComparison comparison;
  std::vector<Agreement> agreements;  ///< by pair
  std::vector<MeanAgreement> means;   ///< by pair
};

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

std::string pair_name(const Compared& of, const IntegratorPair& pair) {
  return of.comparison.trials[pair.a].integrator + " - " + of.comparison.trials[pair.b].integrator;
}

/// One of the paths that either misses, on which they are not held against each other.
std::string missed_by(const Compared& of, const IntegratorPair& pair) {
  const std::string &a = of.comparison.trials[pair.a].missed, &b = of.comparison.trials[pair.b].missed;
  return a.empty() || a == b ? b : b.empty() ? a : a + ", " + b;
}

bool all_agree(const std::vector<Compared>& all) {
  return std::all_of(all.begin(), all.end(), [](const Compared& of) {
    const auto agrees = [](const auto& a) { return a.agrees(); };
    return std::ranges::all_of(of.agreements, agrees) && std::ranges::all_of(of.means, agrees);
  });
}

const char* verdict(const std::vector<Compared>& all) {
  if (!all_agree(all)) return "THEY DO NOT AGREE";
  const bool any = std::any_of(all.begin(), all.end(), [](const Compared& of) { return !of.agreements.empty(); });
  return any ? "all agree" : "nothing was held against anything";
}

std::string efficiency_table(const scene::Scene& scene, const std::vector<Compared>& all) {
  Table table({"measured", "integrator", "samples", "processor s", "error %", "efficiency 1/s", "but paths"});
  for (const Compared& of : all)
    for (const IntegratorTrial& trial : of.comparison.trials) {
      if (!trial.refused.empty()) continue;
      std::uint64_t samples = 0;
      for (const Estimate& each : trial.found) samples = std::max(samples, each.samples);
      const double efficiency = trial.efficiency(scene);
      table.add({of.kind.name, trial.integrator, core::format_count(samples),
                 core::format("%.3g", trial.processor_seconds),
                 core::format("%.2g", 100 / std::sqrt(efficiency * trial.processor_seconds)),
                 core::format("%.3g", efficiency), trial.missed});
    }
  return table.text();
}

std::string agreement_table(const std::vector<Compared>& all, double z_max) {
  Table table({"measured", "held against each other", "comparisons", "largest z", "allowed", "beyond", "worst",
               "mean z", "allowed", "but paths"});
  for (const Compared& of : all)
    for (std::size_t p = 0; p < of.agreements.size(); ++p) {
      const Agreement& a = of.agreements[p];
      const MeanAgreement& mean = of.means[p];
      table.add({of.kind.name, pair_name(of, of.comparison.pairs[p]), core::format_count(a.comparisons),
                 core::format("%.2f", a.largest_z), core::format("%.2f", z_max), core::format_count(a.beyond),
                 of.kind.names[a.worst], core::format("%+.2f", mean.judged ? mean.mean : a.mean_z),
                 mean.judged ? core::format("%.2f%s", mean.allowed, mean.agrees() ? "" : ", BEYOND") : "not judged",
                 missed_by(of, of.comparison.pairs[p])});
    }
  return table.text();
}

/// Of each run: what samples were no numbers, and where one is much.
std::string sample_texts(const std::vector<Compared>& all) {
  std::string text;
  for (const Compared& of : all) {
    const auto add = [&](const std::string& who, const montecarlo::SampleReport& report) {
      if (!report.heavy.empty()) text += of.kind.name + " by " + who + ": " + report.heavy_text(of.kind.names) + "\n";
      if (report.not_finite > 0)
        text += core::format("%s by %s: %llu samples were not finite and count as zero: a bug\n", of.kind.name.c_str(),
                             who.c_str(), static_cast<unsigned long long>(report.not_finite));
    };
    for (const IntegratorTrial& trial : of.comparison.trials) add(trial.integrator, trial.report);
    for (const IntegratorPair& pair : of.comparison.pairs) add(pair_name(of, pair), pair.report);
  }
  return text;
}

void add_samples(const montecarlo::SampleReport& report, const std::vector<std::string>& names,
                 results::Record& record) {
  record.add("samples_not_finite", report.not_finite).add("by_one_sample", report.heavy.size());
  if (!report.heavy.empty()) record.add("worst_by_one_sample", report.heavy_text(names));
}

std::string refusals(const std::vector<Compared>& all) {
  std::string text;
  for (const Compared& of : all)
    for (const IntegratorTrial& trial : of.comparison.trials)
      if (!trial.refused.empty())
        text += trial.integrator + " does not answer " + of.kind.name + ": " + trial.refused + "\n";
  return text;
}

/// Mean irradiances of fluxes; others as they are.
Estimate told(const measure::Measurement& asked, const Estimate& found) {
  return std::holds_alternative<measure::Flux>(asked) ? scaled(found, 1 / montecarlo::scale_of(asked)) : found;
}

const char* unit_of(const scene::Scene& scene, const measure::Measurement& asked) {
  return std::holds_alternative<measure::PixelRadiance>(asked) ? scene.radiance_unit() : scene.irradiance_unit();
}

/// Who found it, what it was held against there (nothing: it was asked for by itself), and of which paths.
struct Finder {
  std::string integrator, against;
  const measure::PathClasses& paths;
};

void add_found(const scene::Scene& scene, const Kind& kind, const Finder& finder, std::span<const Estimate> found,
               results::Csv& csv) {
  const int channels = scene.channel_count();
  for (std::size_t m = 0; m < found.size(); ++m) {
    const Estimate e = told(kind.asked[m], found[m]);
    csv.text(kind.name).text(kind.names[m]).text(unit_of(scene, kind.asked[m]));
    csv.text(finder.integrator).text(finder.against).text(finder.paths.expression());
    csv.integer(static_cast<long long>(e.samples)).number(scene.weigh(e.value));
    csv.number(montecarlo::weighed_standard_error(scene, e)).number(scene.weigh(e.error_bound));
    csv.numbers(e.value, channels).numbers(e.standard_error, channels).numbers(e.error_bound, channels).end_line();
  }
}

std::string csv_of(const scene::Scene& scene, const std::vector<Compared>& all) {
  results::Csv csv;
  for (const char* heading :
       {"kind", "name", "unit", "integrator", "against", "paths", "samples", "value", "standard_error", "error_bound"})
    csv.text(heading);
  for (const char* heading : {"value", "standard_error", "error_bound"}) csv.headings(heading, scene.channel_count());
  csv.end_line();
  for (const Compared& of : all) {
    const std::vector<IntegratorTrial>& trials = of.comparison.trials;
    for (const IntegratorTrial& trial : trials)
      add_found(scene, of.kind, {trial.integrator, "", trial.paths}, trial.found, csv);
    for (const IntegratorPair& pair : of.comparison.pairs) {
      const std::string &a = trials[pair.a].integrator, &b = trials[pair.b].integrator;
      add_found(scene, of.kind, {a, b, pair.common}, pair.of_a, csv);
      add_found(scene, of.kind, {b, a, pair.common}, pair.of_b, csv);
    }
  }
  return csv.str();
}

results::Record record_of(const scene::Scene& scene, const std::vector<Compared>& all, const CompareOptions& options,
                          double z_max, bool stopped) {
  results::Record::List kinds;
  for (const Compared& of : all) {
    results::Record::List trials, pairs;
    for (const IntegratorTrial& t : of.comparison.trials) {
      results::Record trial;
      trial.add("integrator", t.integrator).add("paths", t.paths.expression()).add("missed", t.missed);
      if (!t.refused.empty()) trial.add("refused", t.refused);
      if (t.refused.empty()) {
        trial.add("processor_seconds", t.processor_seconds).add("efficiency", t.efficiency(scene));
        add_samples(t.report, of.kind.names, trial);
      }
      trials.push_back(std::move(trial));
    }
    for (std::size_t p = 0; p < of.agreements.size(); ++p) {
      const Agreement& a = of.agreements[p];
      const MeanAgreement& mean = of.means[p];
      results::Record pair;
      pair.add("pair", pair_name(of, of.comparison.pairs[p]))
          .add("paths", of.comparison.pairs[p].common.expression())
          .add("comparisons", a.comparisons)
          .add("mean_z", mean.judged ? mean.mean : a.mean_z)
          .add("mean_z_judged", mean.judged);
      if (mean.judged) pair.add("mean_z_allowed", mean.allowed);
      add_samples(of.comparison.pairs[p].report, of.kind.names, pair);
      pairs.push_back(pair.add("largest_z", a.largest_z).add("beyond", a.beyond).add("worst", of.kind.names[a.worst]));
    }
    kinds.push_back(results::Record()
                        .add("measured", of.kind.name)
                        .add("measurements", of.kind.asked.size())
                        .add("integrators", std::move(trials))
                        .add("pairs", std::move(pairs)));
  }
  results::Record record;
  record.add("scene", options.scene.string()).add("target", options.target).add("paths", options.paths);
  return record.add("agree", all_agree(all)).add("z_max", z_max).add("stopped", stopped).add("kinds", std::move(kinds));
}

std::string compared_file(const std::string& a, const std::string& b) {
  return core::format("compared_%s_%s.png", a.c_str(), b.c_str());
}

/// What an earlier run left under names that this one does not write would look like a part of it.
void remove_leftovers(const std::filesystem::path& folder) {
  for (const std::string& a : montecarlo::integrator_names()) {
    for (const char* extension : {".exr", ".png"}) std::filesystem::remove(folder / (a + extension));
    for (const std::string& b : montecarlo::integrator_names()) std::filesystem::remove(folder / compared_file(a, b));
  }
}

/// NAME.exr and NAME.png of each, and what differs from the first beside both.
void write_pictures(const scene::Scene& scene, scene::CameraId camera, const std::vector<std::string>& names,
                    const FirstPass& first_pass, const CompareOptions& options, Run& run) {
  const scene::Camera& view = scene.camera(camera);
  const auto pixels = static_cast<std::uint64_t>(view.width) * static_cast<std::uint64_t>(view.height);
  std::vector<std::pair<std::string, CameraPicture>> drawn;
  for (const std::string& name : names) {
    montecarlo::IntegratorSettings settings;
    const auto samples = static_cast<std::uint64_t>(options.samples);
    settings.samples = montecarlo::integrator_entry(name).shares_paths ? samples * pixels : samples;
    settings.intersector = options.intersector;
    settings.paths = measure::PathClasses::of(options.paths);
    settings.solution = first_pass.solution();
    try {
      drawn.emplace_back(name, picture_of(*montecarlo::make_integrator(name, settings), scene, camera, run));
    } catch (const core::InputError& error) {
      core::log::warning("no picture by " + name + ": " + error.what());
      continue;
    }
    const CameraPicture& picture = drawn.back().second;
    results::write_image(options.out / (name + ".exr"), with_errors(picture.radiance, picture.error));
    results::write_image(options.out / (name + ".png"), results::as_rgb(scene, picture.radiance));
    if (drawn.size() < 2) continue;
    const auto& [first, of_first] = drawn.front();
    core::Image noise = picture.error;
    for (std::size_t k = 0; k < noise.data.size(); ++k)
      noise.data[k] = std::hypot(noise.data[k], of_first.error.data[k]) / static_cast<float>(normal_95);
    const auto panels = results::comparison_panels(scene, picture.radiance, of_first.radiance, noise, difference_scale);
    results::write_png(options.out / compared_file(name, first),
                       beside_each_other(panels,
                                         {name + core::format(", %d samples a pixel", options.samples), first,
                                          core::format("(%s - %s) / mean, white within 3 standard errors", name.c_str(),
                                                       first.c_str())},
                                         difference_scale));
  }
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
    all.push_back({kind, compare_integrators(scene, kind.asked, names, settings, run, options.replications), {}, {}});
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

/// Of all integrators those that need no solution of another method.
std::vector<std::string> those_by_themselves() {
  std::vector<std::string> names;
  for (const montecarlo::IntegratorEntry& each : montecarlo::known_integrators())
    if (!each.needs_solution) names.push_back(each.name);
  return names;
}

}  // namespace

ExitStatus compare(const CompareOptions& options, const CommonOptions& common, Run& run) {
  measure::PathClasses::of(options.paths);  // before the work
  scene::Scene scene = read_and_note(options.scene);
  std::optional<scene::CameraId> camera, few;
  if (!scene.cameras.empty() || !options.camera.empty()) {
    camera = camera_named(scene, options.camera);
    few = scene::CameraId{static_cast<std::uint32_t>(scene.cameras.size())};
    scene.cameras.push_back(coarse(scene.camera(*camera)));
  }
  const std::vector<std::string> names = options.integrators.empty() ? those_by_themselves() : options.integrators;
  const results::OutputDirectory out(options.out);
  remove_leftovers(options.out);
  const FirstPass first_pass(scene, names, measure::PathClasses::of(options.paths), options.intersector, run);
  std::vector<Compared> all = compared(scene, kinds_of(scene, few), names, first_pass, options, run);
  const double z_max = judge(scene, all);
  const auto write_record = [&] {
    results::write_json(options.out / "compare.json", record_of(scene, all, options, z_max, run.stop.stop_requested()));
  };
  results::write_atomically(options.out / "compare.csv", csv_of(scene, all));
  write_record();
  const bool talk = !common.json && !common.quiet;
  if (talk)
    std::printf("%s\n%s%s%s%s\n", efficiency_table(scene, all).c_str(), agreement_table(all, z_max).c_str(),
                refusals(all).c_str(), sample_texts(all).c_str(), verdict(all));
  std::fflush(stdout);
  try {
    if (options.pictures && camera) write_pictures(scene, *camera, names, first_pass, options, run);
  } catch (const core::Interrupted&) {
    core::log::warning("stopped: not every picture was drawn");
  }
  if (run.stop.stop_requested()) write_record();
  if (common.json)
    std::printf("%s\n", results::json_text(record_of(scene, all, options, z_max, run.stop.stop_requested())).c_str());
  if (talk) std::printf("written to %s\n", options.out.string().c_str());
  return all_agree(all) && !run.stop.stop_requested() ? success : not_met;
}

}  // namespace interflect::apps
