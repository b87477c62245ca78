#include "apps/comparison_report.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "apps/table.h"
#include "core/format.h"
#include "montecarlo/integrators.h"
#include "montecarlo/measurable.h"
#include "montecarlo/ray_tree/whitted.h"
#include "montecarlo/tally.h"
#include "results/csv.h"

namespace interflect::apps {
namespace {

using Compared = IntegratorsCompared;
using montecarlo::IntegratorPair;
using montecarlo::IntegratorTrial;
using validation::Agreement;
using validation::MeanAgreement;

std::string pair_name(const Compared& of, const IntegratorPair& pair) {
  return of.comparison.trials[pair.a].integrator + " - " + of.comparison.trials[pair.b].integrator;
}

/// One of the paths that either misses, on which they are not held against each other.
std::string missed_by(const Compared& of, const IntegratorPair& pair) {
  const std::string &a = of.comparison.trials[pair.a].missed, &b = of.comparison.trials[pair.b].missed;
  return a.empty() || a == b ? b : b.empty() ? a : a + ", " + b;
}

const char* verdict(const std::vector<Compared>& all) {
  if (!all_agree(all)) return "THEY DO NOT AGREE on what was measured; pictures are not judged";
  const bool any = std::any_of(all.begin(), all.end(), [](const Compared& of) { return !of.agreements.empty(); });
  return any ? "all agree on what was measured; pictures are not judged" : "nothing was held against anything";
}

/// Why 1 / (variance x time) says nothing of a trial; empty where it does.
std::string why_no_efficiency(const scene::Scene& scene, const IntegratorTrial& trial) {
  const montecarlo::RelativeErrors errors = trial.relative_errors(scene);
  if (errors.over == 0) return "all values are 0";
  if (!std::isfinite(errors.both())) return "not every error is known";
  if (errors.both() == 0) return "no value has an error";
  return trial.processor_seconds > 0 ? "" : "it took no time that a clock shows";
}

std::string efficiency_table(const scene::Scene& scene, const std::vector<Compared>& all) {
  Table table(
      {"measured", "integrator", "samples", "processor s", "error %", "of it bound %", "efficiency 1/s", "but paths"});
  std::string without;
  for (const Compared& of : all)
    for (const IntegratorTrial& trial : of.comparison.trials) {
      if (!trial.refused.empty()) continue;
      std::uint64_t samples = 0;
      for (const Estimate& each : trial.found) samples = std::max(samples, each.samples);
      const montecarlo::RelativeErrors errors = trial.relative_errors(scene);
      const bool known = errors.over > 0;
      const std::string none = why_no_efficiency(scene, trial);
      table.add({of.kind.name, trial.integrator, core::format_count(samples),
                 core::format("%.3g", trial.processor_seconds), known ? core::format("%.2g", 100 * errors.both()) : "-",
                 errors.bound > 0 ? core::format("%.2g", 100 * errors.bound) : "",
                 none.empty() ? core::format("%.3g", trial.efficiency(scene)) : "-", trial.missed});
      if (!none.empty()) without += trial.integrator + " has no efficiency of " + of.kind.name + ": " + none + "\n";
    }
  return table.text() + without;
}

/// Of integrators whose error bound is that of a solution made before: samples do not lower it.
bool is_beyond_by_its_bound(const scene::Scene& scene, const IntegratorTrial& trial, double target) {
  return montecarlo::integrator_entry(trial.integrator).inherits_error && trial.relative_errors(scene).bound > target;
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
      if (!report.rare.empty()) text += of.kind.name + " by " + who + ", " + report.rare_text(of.kind.names) + "\n";
      if (report.not_finite > 0)
        text += core::format("%s by %s: %llu samples were not finite and count as zero: a bug\n", of.kind.name.c_str(),
                             who.c_str(), static_cast<unsigned long long>(report.not_finite));
    };
    for (const IntegratorTrial& trial : of.comparison.trials) add(trial.integrator, trial.report);
    for (const IntegratorPair& pair : of.comparison.pairs) add(pair_name(of, pair), pair.report);
  }
  return text;
}

/// Of each integrator that no number of samples brings to the target, how far it is from that, and why.
std::string bound_texts(const scene::Scene& scene, const std::vector<Compared>& all, double target) {
  std::string text;
  for (const Compared& of : all)
    for (const IntegratorTrial& trial : of.comparison.trials) {
      if (!is_beyond_by_its_bound(scene, trial, target)) continue;
      const montecarlo::RelativeErrors errors = trial.relative_errors(scene);
      text += core::format(
          "%s misses --target %.3g %% of %s by its error bound, %.2g %% beside a noise of %.2g %%: more samples do not "
          "lower that, it is of the solution that they start from\n",
          trial.integrator.c_str(), 100 * target, of.kind.name.c_str(), 100 * errors.bound, 100 * errors.noise);
    }
  return text;
}

/// Of quadratures, where they ended before they were known to be as good as asked.
std::string quadrature_texts(const std::vector<Compared>& all, double target) {
  std::string text;
  for (const Compared& of : all)
    for (const IntegratorTrial& trial : of.comparison.trials) {
      if (!montecarlo::integrator_entry(trial.integrator).by_quadrature) continue;
      const auto at_end = std::ranges::count_if(
          trial.found, [](const Estimate& each) { return each.samples >= montecarlo::WhittedSettings{}.max_samples; });
      if (at_end > 0)
        text += core::format(
            "%s of %s: %td of %zu took all the points that its quadrature may have, and may miss "
            "--target %.3g %%\n",
            trial.integrator.c_str(), of.kind.name.c_str(), at_end, trial.found.size(), 100 * target);
    }
  return text;
}

void add_samples(const montecarlo::SampleReport& report, const std::vector<std::string>& names,
                 results::Record& record) {
  record.add("samples_not_finite", report.not_finite).add("by_one_sample", report.heavy.size());
  if (!report.heavy.empty()) record.add("worst_by_one_sample", report.heavy_text(names));
  if (!report.rare.empty()) record.add("rare_light", report.rare_text(names));
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

void add_found(const scene::Scene& scene, const ComparedKind& kind, const Finder& finder,
               std::span<const Estimate> found, results::Csv& csv) {
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

results::Record record_of(const scene::Scene& scene, const ComparedKind& kind, const IntegratorTrial& trial,
                          double target) {
  results::Record record;
  record.add("integrator", trial.integrator).add("paths", trial.paths.expression()).add("missed", trial.missed);
  if (!trial.refused.empty()) return record.add("refused", trial.refused);
  const montecarlo::RelativeErrors errors = trial.relative_errors(scene);
  record.add("processor_seconds", trial.processor_seconds);
  if (const std::string none = why_no_efficiency(scene, trial); none.empty())
    record.add("efficiency", trial.efficiency(scene));
  else
    record.add_nothing("efficiency").add("no_efficiency", none);
  record.add("relative_noise", errors.noise)
      .add("relative_bound", errors.bound)
      .add("misses_target_by_bound", is_beyond_by_its_bound(scene, trial, target));
  add_samples(trial.report, kind.names, record);
  return record;
}

results::Record record_of(const PictureDrawn& picture) {
  results::Record record;
  record.add("integrator", picture.by).add("paths", picture.of.paths.expression()).add("missed", picture.of.missed);
  if (!picture.refused.empty()) return record.add("refused", picture.refused);
  record.add("files", picture.files).add("samples", picture.samples).add("complete", picture.complete);
  record.add("samples_not_finite", picture.report.not_finite).add("by_one_sample", picture.report.heavy.size());
  if (!picture.report.rare.empty()) record.add("rare_light", picture.report.rare);
  return record;
}

results::Record record_of(const DifferenceDrawn& difference) {
  results::Record record;
  record.add("pair", difference.a + " - " + difference.b)
      .add("paths", difference.of.paths.expression())
      .add("missed", difference.of.missed);
  if (!difference.refused.empty()) return record.add("refused", difference.refused);
  record.add("files", difference.files).add("samples", difference.samples).add("complete", difference.complete);
  const results::BlocksApart& apart = difference.apart;
  record.add("blocks", apart.blocks).add("blocks_brighter", apart.brighter).add("blocks_darker", apart.darker);
  record.add("blocks_by_chance", apart.by_chance());
  if (difference.is_judged()) record.add("explained_by_errors", apart.is_explained());
  if (!difference.rare.empty()) record.add("rare_light", difference.rare);
  return record;
}

/// Of one that errors do not explain.
std::string text_of(const DifferenceDrawn& difference) {
  const results::BlocksApart& apart = difference.apart;
  return core::format(
             "%s: of %zu blocks %s is brighter in %zu and darker in %zu by more than three standard errors, of which "
             "chance explains %zu either way: errors of %llu samples a pixel do not know all, as of light that "
             "is met rarely",
             difference.files.front().c_str(), apart.blocks, difference.a.c_str(), apart.brighter, apart.darker,
             apart.by_chance(), static_cast<unsigned long long>(difference.samples)) +
         (difference.rare.empty() ? "" : " (" + difference.rare + ")") + "\n";
}

results::Record record_of(const TimesSpent& times) {
  return results::Record()
      .add("solving", times.solving)
      .add("measuring", times.comparing.measuring)
      .add("on_common_paths", times.comparing.on_common_paths)
      .add("replications", times.comparing.replications)
      .add("pictures", times.pictures);
}

template <class Drawn>
results::Record::List records_of(const std::vector<Drawn>& drawn) {
  results::Record::List records;
  for (const Drawn& each : drawn) records.push_back(record_of(each));
  return records;
}

results::Record record_of(const Compared& of, std::size_t p) {
  const Agreement& a = of.agreements[p];
  const MeanAgreement& mean = of.means[p];
  const IntegratorPair& pair = of.comparison.pairs[p];
  results::Record record;
  record.add("pair", pair_name(of, pair))
      .add("paths", pair.common.expression())
      .add("comparisons", a.comparisons)
      .add("mean_z", mean.judged ? mean.mean : a.mean_z)
      .add("mean_z_judged", mean.judged);
  if (mean.judged) record.add("mean_z_allowed", mean.allowed);
  add_samples(pair.report, of.kind.names, record);
  return record.add("largest_z", a.largest_z).add("beyond", a.beyond).add("worst", of.kind.names[a.worst]);
}

}  // namespace

bool all_agree(const std::vector<Compared>& all) {
  return std::all_of(all.begin(), all.end(), [](const Compared& of) {
    const auto agrees = [](const auto& a) { return a.agrees(); };
    return std::ranges::all_of(of.agreements, agrees) && std::ranges::all_of(of.means, agrees);
  });
}

std::string comparison_text(const scene::Scene& scene, const std::vector<Compared>& all, double target, double z_max) {
  return efficiency_table(scene, all) + bound_texts(scene, all, target) + quadrature_texts(all, target) + "\n" +
         agreement_table(all, z_max) + refusals(all) + sample_texts(all) + verdict(all) + "\n";
}

std::string comparison_csv(const scene::Scene& scene, const std::vector<Compared>& all) {
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

std::string pictures_text(const PicturesDrawn& pictures) {
  std::string text;
  for (const PictureDrawn& each : pictures.pictures) {
    if (!each.refused.empty()) continue;
    const std::string& file = each.files.back();
    if (!each.of.missed.empty())
      text += file + ": all that " + each.by + " finds, not such paths as " + each.of.missed + "\n";
    for (const std::string& line : {each.report.rare, each.heavy})
      if (!line.empty()) text += file + ": " + line + "\n";
    if (each.report.not_finite > 0)
      text += core::format("%s: %llu samples were not finite and count as zero: a bug\n", file.c_str(),
                           static_cast<unsigned long long>(each.report.not_finite));
  }
  for (const DifferenceDrawn& each : pictures.differences)
    if (each.refused.empty() && each.is_beyond_errors()) text += text_of(each);
  return text;
}

TimesSpent times_spent(const std::vector<Compared>& all, const measure::SurfaceSolution& solution,
                       const PicturesDrawn& pictures) {
  TimesSpent spent{.solving = solution.processor_seconds, .pictures = pictures.processor_seconds};
  for (const Compared& of : all) {
    spent.comparing.measuring += of.comparison.times.measuring;
    spent.comparing.on_common_paths += of.comparison.times.on_common_paths;
    spent.comparing.replications += of.comparison.times.replications;
  }
  return spent;
}

std::string times_text(const TimesSpent& times) {
  std::string text;
  const auto add = [&](double seconds, const char* what) {
    if (seconds > 0) text += (text.empty() ? "" : ", ") + core::format_duration(seconds) + " " + what;
  };
  add(times.solving, "for the solution that some start from");
  add(times.comparing.measuring, times.solving > 0
                                     ? "measuring (the table's column has the solution's in each kind, too)"
                                     : "measuring (the table's column)");
  add(times.comparing.on_common_paths, "once more on the paths that pairs have in common");
  add(times.comparing.replications, "in replications (--replications)");
  add(times.pictures, "for pictures (--spp, --no-pictures)");
  return "took " + core::format_duration(times.elapsed) + (text.empty() ? "" : "; processors " + text) + "\n";
}

results::Record comparison_record(const scene::Scene& scene, const std::vector<Compared>& all,
                                  const CompareOptions& options, double z_max, bool stopped,
                                  const PicturesDrawn& pictures, const TimesSpent& times) {
  results::Record::List kinds;
  for (const Compared& of : all) {
    results::Record::List trials, pairs;
    for (const IntegratorTrial& trial : of.comparison.trials)
      trials.push_back(record_of(scene, of.kind, trial, options.target));
    for (std::size_t p = 0; p < of.agreements.size(); ++p) pairs.push_back(record_of(of, p));
    kinds.push_back(results::Record()
                        .add("measured", of.kind.name)
                        .add("measurements", of.kind.asked.size())
                        .add("integrators", std::move(trials))
                        .add("pairs", std::move(pairs)));
  }
  results::Record record;
  record.add("scene", options.scene.string()).add("target", options.target).add("paths", options.paths);
  record.add("pictures", pictures.files()).add("drawn", records_of(pictures.pictures));
  record.add("differences", records_of(pictures.differences));
  record.add("seconds", times.elapsed).add("processor_seconds", record_of(times));
  return record.add("agree", all_agree(all)).add("z_max", z_max).add("stopped", stopped).add("kinds", std::move(kinds));
}

}  // namespace interflect::apps
